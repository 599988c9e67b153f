// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Milliseconds a frame of what stands before and behind the integrator, 848 x 480 pixels of a
// simulated flight through the apartment: the gate for bad frames, the straightening of distorted
// depths, and a look for ghosts (which a frame in four needs at integrate.decay_s = 2 and 30 Hz).

#include <benchmark/benchmark.h>

#include <vector>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/preprocess/depth_step.hpp"
#include "swiftlet/source/sources.hpp"

namespace {

using namespace swiftlet;

std::vector<Frame> every_tenth_frame() {
  constexpr int kFrames = 30, kEvery = 10;
  std::vector<Frame> frames;
  auto source = open_source("sim:apartment");
  for (int i = 0; source && i < kFrames * kEvery; ++i) {
    auto frame = (*source)->next();
    if (!frame || !*frame) break;
    if (i % kEvery == 0) frames.push_back(std::move(**frame));
  }
  return frames;
}
const std::vector<Frame>& frames() {
  static const std::vector<Frame> kFrames = every_tenth_frame();
  return kFrames;
}

void gate(benchmark::State& state) {
  if (frames().empty()) return state.SkipWithError("the simulated rig was not built");
  FrameGate gate({});
  std::size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(gate.refusal(frames()[i++ % frames().size()]));
}

void distortion(benchmark::State& state) {
  if (frames().empty()) return state.SkipWithError("the simulated rig was not built");
  PreprocessOptions options;
  options.distortion = {0.05, 0.05, 0.01, 0.01, 0.01};
  const auto step = find_registered(depth_steps(), "distortion", "step")->make(options);
  PreprocessedDepth depth;
  depth.raw = frames().front().depth.raw;
  depth.intrinsics = frames().front().intrinsics;
  for (auto _ : state) step->apply(depth);
}

void occupancy_decay(benchmark::State& state) {
  if (frames().empty()) return state.SkipWithError("the simulated rig was not built");
  MapperConfig config;
  config.map.voxel_m = 0.001 * static_cast<double>(state.range(0));
  auto mapper = Mapper::create(config);
  for (const Frame& frame : frames()) mapper->integrate(frame);
  const Frame& frame = frames().back();
  PreprocessedDepth depth;
  depth.raw = frame.depth.raw;
  DepthRangePyramid pyramid;
  pyramid.build(depth.raw);
  const DepthView view{depth, pyramid, frame.intrinsics, frame.T_world_camera, 0};
  OccupancyDecay decay(2.0);
  Stamp now;
  for (auto _ : state) {
    now = now + std::chrono::milliseconds(130);  // so that every look is taken
    benchmark::DoNotOptimize(
        decay.apply(view, {now, 0, 0.004, config.depth.max_range_m}, mapper->map()));
  }
}

BENCHMARK(gate)->Unit(benchmark::kMillisecond);
BENCHMARK(distortion)->Unit(benchmark::kMillisecond);
BENCHMARK(occupancy_decay)->Arg(200)->Arg(100)->Arg(50)->Unit(benchmark::kMillisecond);

}  // namespace
