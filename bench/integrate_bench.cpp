// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Milliseconds a frame, from the conditioned depth image to the updated map, of every integrator
// and of OctoMap, on the same frames of a simulated flight through the apartment: 848 x 480 pixels,
// every one of them used, range 10 m.

#include <benchmark/benchmark.h>

#include <vector>

#include "swiftlet/condition/conditioner.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/source/sources.hpp"

#if SWIFTLET_HAS_OCTOMAP
#include <octomap/octomap.h>
#endif

namespace {

using namespace swiftlet;

constexpr double kRange_m = 10.0;

/// Every tenth frame from the start of the flight, conditioned; made once.
struct Flight {
  std::vector<Frame> frames;
  std::vector<ConditionedDepth> depths;
};

const Flight& flight() {
  static const Flight kFlight = [] {
    constexpr int kFrames = 60, kEvery = 10;
    Flight made;
    auto source = open_source("sim:apartment");
    auto conditioner = Conditioner::create({.max_range_m = kRange_m, .downsample = 1});
    if (!source || !conditioner) return made;
    for (int i = 0; i < kFrames * kEvery; ++i) {
      auto frame = (*source)->next();
      if (!frame || !*frame) break;
      if (i % kEvery != 0) continue;
      made.depths.push_back(conditioner->clean((*frame)->depth));
      made.frames.push_back(std::move(**frame));
    }
    return made;
  }();
  return kFlight;
}

double voxel_of(const benchmark::State& state) {
  return 0.001 * static_cast<double>(state.range(0));
}

void integrate(benchmark::State& state, const char* name) {
  const Flight& f = flight();
  if (f.frames.empty()) return state.SkipWithError("the simulated rig was not built");
  const double voxel_m = voxel_of(state);
  auto integrator = make_integrator({.integrator = name});
  auto map = RollingMap::create({.voxel_m = voxel_m});
  std::size_t i = 0;
  for (auto _ : state) {
    const Frame& frame = f.frames[i % f.frames.size()];
    const ConditionedDepth& depth = f.depths[i % f.frames.size()];
    map->recentre(frame.T_world_camera.translation(), nullptr);
    const StereoSensor sensor(frame.intrinsics, {}, voxel_m, 1);
    const auto tally =
        (*integrator)->integrate({depth, frame.intrinsics, frame.T_world_camera, i}, sensor, *map);
    benchmark::DoNotOptimize(tally);
    ++i;
  }
  state.counters["map_MB"] = 1e-6 * static_cast<double>(map->memory_bytes());
}

void rays(benchmark::State& state) { integrate(state, "rays"); }
void projective(benchmark::State& state) { integrate(state, "projective"); }

BENCHMARK(projective)->Arg(200)->Arg(100)->Arg(50)->Unit(benchmark::kMillisecond)->Iterations(120);
BENCHMARK(rays)->Arg(200)->Arg(100)->Arg(50)->Unit(benchmark::kMillisecond)->Iterations(30);

#if SWIFTLET_HAS_OCTOMAP

octomap::Pointcloud cloud_of(const Frame& frame, const ConditionedDepth& depth) {
  octomap::Pointcloud cloud;
  cloud.reserve(depth.raw.pixels().size());
  for (int v = 0; v < depth.raw.height(); ++v) {
    for (int u = 0; u < depth.raw.width(); ++u) {
      const std::uint16_t raw = depth.raw.at(u, v);
      if (raw == 0) continue;
      const Eigen::Vector3f p =
          (frame.T_world_camera * frame.intrinsics.back_project(u, v, double{depth.unit_m} * raw))
              .cast<float>();
      cloud.push_back(p.x(), p.y(), p.z());
    }
  }
  return cloud;
}

/// Point cloud conversion included, as its user has to do it.
void octomap_insert(benchmark::State& state, bool is_discretised) {
  const Flight& f = flight();
  if (f.frames.empty()) return state.SkipWithError("the simulated rig was not built");
  octomap::OcTree tree(voxel_of(state));
  std::size_t i = 0;
  for (auto _ : state) {
    const Frame& frame = f.frames[i % f.frames.size()];
    const Eigen::Vector3f origin = frame.T_world_camera.translation().cast<float>();
    tree.insertPointCloud(cloud_of(frame, f.depths[i % f.frames.size()]),
                          {origin.x(), origin.y(), origin.z()}, kRange_m, false, is_discretised);
    ++i;
  }
  state.counters["map_MB"] = 1e-6 * static_cast<double>(tree.memoryUsage());
}

void octomap_plain(benchmark::State& state) { octomap_insert(state, false); }
void octomap_discretised(benchmark::State& state) { octomap_insert(state, true); }

BENCHMARK(octomap_plain)->Arg(200)->Arg(50)->Unit(benchmark::kMillisecond)->Iterations(20);
BENCHMARK(octomap_discretised)->Arg(200)->Arg(50)->Unit(benchmark::kMillisecond)->Iterations(30);

#endif

}  // namespace
