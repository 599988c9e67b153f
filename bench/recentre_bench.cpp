// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What a move of the window costs: one block to the side, windows of growing length along x, all
// blocks in use. The slab that leaves has the same size in all of them, so the time must not grow
// with the window. Beside it: the same window length, growing slab.

#include <benchmark/benchmark.h>

#include "swiftlet/map/rolling_map.hpp"

namespace {

using namespace swiftlet;

constexpr double kVoxel_m = 0.1;
constexpr double kBlock_m = kVoxel_m * kBlockEdge;

void fill(RollingMap& map, const BlockWindow& window) {
  for_each_block(window, [&](const BlockIndex& b) {
    if (map.find(b) == nullptr) map.writable(b).voxels.fill(20);
  });
}

/// Moves by one block along x, there and back; the entering slab is filled outside the timing.
void move_one_block(benchmark::State& state, const Eigen::Vector3d& size_blocks) {
  auto map = RollingMap::create({.voxel_m = kVoxel_m,
                                 .size_m = size_blocks * kBlock_m,
                                 .trigger_m = {0.5 * kBlock_m, 1e3, 1e3}});
  double x_m = 0.0;
  map->recentre({x_m, 0, 0}, nullptr);
  fill(*map, map->window());
  for (auto _ : state) {
    x_m += kBlock_m;
    const auto shift = map->recentre({x_m, 0, 0}, nullptr);
    benchmark::DoNotOptimize(shift);
    state.PauseTiming();
    fill(*map, map->window());
    state.ResumeTiming();
  }
  const auto blocks = static_cast<double>(map->window().block_count());
  state.counters["window_blocks"] = blocks;
  state.counters["slab_blocks"] = blocks / map->window().size.x;
}

void window_grows(benchmark::State& state) {
  move_one_block(state, {double(state.range(0)), 15.0, 7.0});
}
void slab_grows(benchmark::State& state) {
  move_one_block(state, {15.0, double(state.range(0)), 7.0});
}

BENCHMARK(window_grows)->RangeMultiplier(4)->Range(8, 512)->Iterations(400);
BENCHMARK(slab_grows)->RangeMultiplier(4)->Range(8, 512)->Iterations(400);

}  // namespace
