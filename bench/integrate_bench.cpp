// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Milliseconds a frame, from the conditioned depth image to the updated map, of every integrator on
// the same frames of a simulated flight through the apartment: 848 x 480 pixels, every one of them
// used, range 10 m. `swiftlet bench` measures whole mappers, beside OctoMap.

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/integrate/measurement_models.hpp"
#include "swiftlet/preprocess/preprocessor.hpp"
#include "swiftlet/source/sources.hpp"

namespace {

using namespace swiftlet;

constexpr double kRange_m = 10.0;

/// Every tenth frame from the start of the flight, conditioned; made once.
struct Flight {
  std::vector<Frame> frames;
  std::vector<PreprocessedDepth> depths;
};

const Flight& flight() {
  static const Flight kFlight = [] {
    constexpr int kFrames = 60, kEvery = 10;
    Flight made;
    auto source = open_source("sim:apartment");
    auto preprocessor = Preprocessor::create({.max_range_m = kRange_m, .downsample = 1});
    if (!source || !preprocessor) return made;
    for (int i = 0; i < kFrames * kEvery; ++i) {
      auto frame = (*source)->next();
      if (!frame || !*frame) break;
      if (i % kEvery != 0) continue;
      made.depths.push_back(preprocessor->clean((*frame)->depth, (*frame)->intrinsics, {}));
      made.frames.push_back(std::move(**frame));
    }
    return made;
  }();
  return kFlight;
}

double voxel_of(const benchmark::State& state) {
  return 0.001 * static_cast<double>(state.range(0));
}

void integrate(benchmark::State& state, const char* name, std::string_view model_name) {
  const Flight& f = flight();
  if (f.frames.empty()) return state.SkipWithError("the simulated rig was not built");
  const double voxel_m = voxel_of(state);
  auto integrator = make_integrator({.integrator = name});
  const auto model = find_measurement_model(model_name)->make();
  auto map = RollingMap::create({.voxel_m = voxel_m});
  DepthRangePyramid pyramid;
  std::size_t i = 0;
  for (auto _ : state) {
    const Frame& frame = f.frames[i % f.frames.size()];
    const PreprocessedDepth& depth = f.depths[i % f.frames.size()];
    map->recentre(frame.T_world_camera.translation(), nullptr);
    const StereoSensor sensor(frame.intrinsics, {}, voxel_m, 1);
    pyramid.build(depth.raw);
    const DepthView view{depth, pyramid, frame.intrinsics, frame.T_world_camera, i};
    const auto tally = (*integrator)->integrate(view, sensor, *model, *map);
    benchmark::DoNotOptimize(tally);
    ++i;
  }
  state.counters["map_MB"] = 1e-6 * static_cast<double>(map->memory_bytes());
}

/// Every integrator with every registered model.
void declare_benchmarks() {
  for (const auto& model : measurement_models()) {
    for (const char* name : {"projective", "rays"}) {
      const std::string title = std::string(name) + "/" + std::string(model.name);
      const bool is_slow = std::string_view(name) == "rays";
      benchmark::RegisterBenchmark(
          title.c_str(), [=](benchmark::State& state) { integrate(state, name, model.name); })
          ->Arg(200)
          ->Arg(100)
          ->Arg(50)
          ->Unit(benchmark::kMillisecond)
          ->Iterations(is_slow ? 30 : 120);
    }
  }
}
[[maybe_unused]] const bool kAreDeclared = (declare_benchmarks(), true);

}  // namespace
