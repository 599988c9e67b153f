// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What a planner's questions cost, in the apartment's map at 0.1 m: a swept sphere of 0.4 m along
// 5 m, in free air and through all that stands there, with a distance field and without; the
// frontier after each frame of a flight, and all of it at once; its clusters; what one view would
// tell.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <vector>

#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/query/distance/distance_field.hpp"
#include "swiftlet/query/explore/frontier_clusters.hpp"
#include "swiftlet/query/explore/view_gain.hpp"
#include "swiftlet/query/sweep/sweep.hpp"
#include "swiftlet/source/sources.hpp"

namespace {

using namespace swiftlet;

/// Every fifth frame of the flight, and the map that they make.
struct MappedFlight {
  std::vector<Frame> frames;
  std::optional<Mapper> mapper;
  std::optional<MapSnapshot> map;

  MappedFlight() {
    auto source = open_source("sim:apartment");
    for (int i = 0; source; ++i) {
      auto frame = (*source)->next();
      if (!frame || !*frame) break;
      if (i % 5 == 0) frames.push_back(std::move(**frame));
    }
    mapper.emplace(std::move(*Mapper::create(config())));
    for (const Frame& frame : frames) mapper->integrate(frame);
    map = mapper->snapshot();
  }
  static MapperConfig config() {
    MapperConfig config;
    config.map.voxel_m = 0.1;
    return config;
  }
};
MappedFlight& mapped_flight() {
  static MappedFlight kMapped;
  return kMapped;
}

/// Paths of 5 m in 32 directions from where the flight ended.
std::vector<std::array<Eigen::Vector3d, 2>> paths() {
  std::vector<std::array<Eigen::Vector3d, 2>> paths;
  const Eigen::Vector3d from = mapped_flight().frames.back().T_world_camera.translation();
  for (int i = 0; i < 32; ++i) {
    const double yaw_rad = 2.0 * std::numbers::pi * i / 32;
    const Eigen::Vector3d step(5.0 * std::cos(yaw_rad), 5.0 * std::sin(yaw_rad), 0.3);
    paths.push_back({from, from + step});
  }
  return paths;
}

void sweep_paths(benchmark::State& state, const MapSnapshot& map, const SweepPolicy& policy) {
  const auto body = BodyShape::sphere(0.4);
  const auto all = paths();
  std::size_t i = 0, clear = 0;
  for (auto _ : state) {
    const auto answer = sweep(map, *body, *SweepPath::along(all[i++ % all.size()]), policy);
    clear += answer->state == SweepState::kClear ? 1 : 0;
  }
  state.counters["clear"] =
      benchmark::Counter(static_cast<double>(clear), benchmark::Counter::kAvgIterations);
}

/// A voxel blocks, but is not the end of it: what is unknown stops the body at the first contact.
void sweep_apartment(benchmark::State& state) {
  if (mapped_flight().frames.empty()) return state.SkipWithError("the simulated rig was not built");
  sweep_paths(state, *mapped_flight().map, {});
}
void sweep_apartment_with_clearance(benchmark::State& state) {
  if (mapped_flight().frames.empty()) return state.SkipWithError("the simulated rig was not built");
  sweep_paths(state, *mapped_flight().map, {.clearance_reach_m = 1.0});
}

/// A map that is free within a distance of a line, and occupied beyond.
MapSnapshot corridor(double half_width_m) {
  auto map = RollingMap::create({.voxel_m = 0.1, .size_m = {20, 20, 6}, .trigger_m = {1, 1, 1}});
  map->recentre({0, 0, 0}, nullptr);
  for_each_block(map->window(), [&](const BlockIndex& b) {
    VoxelBlock& block = map->writable(b);
    for (int i = 0; i < kBlockVoxels; ++i) {
      const Eigen::Vector3d p = centre_of(voxel_at(b, i), 0.1);
      const bool is_wall = std::abs(p.y() - 0.5 * p.x()) > half_width_m;
      block.voxels[static_cast<std::size_t>(i)] = is_wall ? 230 : 20;
    }
  });
  return *map->snapshot({1});
}
void sweep_clear(benchmark::State& state, double half_width_m, bool has_field) {
  const MapSnapshot map = corridor(half_width_m);
  auto field = DistanceField::create(0.1, map.window().size, {});
  field->update(map);
  const auto body = BodyShape::sphere(0.4);
  const double along_m = 2.5 / std::hypot(1.0, 0.5);
  const std::array<Eigen::Vector3d, 2> path{Eigen::Vector3d(-along_m, -0.5 * along_m, 0),
                                            Eigen::Vector3d(along_m, 0.5 * along_m, 0)};
  const SweepPolicy policy{.field = has_field ? &*field : nullptr};
  for (auto _ : state) {
    const auto answer = sweep(map, *body, *SweepPath::along(path), policy);
    if (answer->state != SweepState::kClear) return state.SkipWithError("not clear");
  }
}
/// Nothing stops it, and walls pass by at 0.1 m from its skin on both sides, or at half a metre.
void sweep_corridor(benchmark::State& state) { sweep_clear(state, 0.6, false); }
void sweep_corridor_with_field(benchmark::State& state) { sweep_clear(state, 0.6, true); }
void sweep_wide_corridor(benchmark::State& state) { sweep_clear(state, 1.1, false); }
void sweep_wide_corridor_with_field(benchmark::State& state) { sweep_clear(state, 1.1, true); }

/// The frontier after each frame; the mapper works outside the timing.
void frontier_in_flight(benchmark::State& state) {
  if (mapped_flight().frames.empty()) return state.SkipWithError("the simulated rig was not built");
  auto mapper = Mapper::create(MappedFlight::config());
  FrontierMap frontier;
  std::size_t i = 0;
  for (auto _ : state) {
    state.PauseTiming();
    mapper->integrate(mapped_flight().frames[i++ % mapped_flight().frames.size()]);
    const auto map = mapper->snapshot();
    state.ResumeTiming();
    frontier.update(*map);
  }
  state.counters["voxels"] = static_cast<double>(frontier.voxel_count());
}
void frontier_from_scratch(benchmark::State& state) {
  if (mapped_flight().frames.empty()) return state.SkipWithError("the simulated rig was not built");
  FrontierMap frontier;
  for (auto _ : state) {
    frontier.clear();
    frontier.update(*mapped_flight().map);
  }
}
void frontier_clusters(benchmark::State& state) {
  if (mapped_flight().frames.empty()) return state.SkipWithError("the simulated rig was not built");
  FrontierMap frontier;
  frontier.update(*mapped_flight().map);
  for (auto _ : state) benchmark::DoNotOptimize(cluster_frontier(frontier));
}
void view_gain(benchmark::State& state) {
  if (mapped_flight().frames.empty()) return state.SkipWithError("the simulated rig was not built");
  ViewGain gain;
  const auto T = mapped_flight().frames.back().T_world_camera;
  for (auto _ : state) benchmark::DoNotOptimize(gain.unknown_in_sight(*mapped_flight().map, T, {}));
}

BENCHMARK(sweep_apartment)->Unit(benchmark::kMicrosecond);
BENCHMARK(sweep_apartment_with_clearance)->Unit(benchmark::kMicrosecond);
BENCHMARK(sweep_corridor)->Unit(benchmark::kMicrosecond);
BENCHMARK(sweep_corridor_with_field)->Unit(benchmark::kMicrosecond);
BENCHMARK(sweep_wide_corridor)->Unit(benchmark::kMicrosecond);
BENCHMARK(sweep_wide_corridor_with_field)->Unit(benchmark::kMicrosecond);
BENCHMARK(frontier_in_flight)->Unit(benchmark::kMicrosecond)->Iterations(500);
BENCHMARK(frontier_from_scratch)->Unit(benchmark::kMicrosecond);
BENCHMARK(frontier_clusters)->Unit(benchmark::kMicrosecond);
BENCHMARK(view_gain)->Unit(benchmark::kMicrosecond);

}  // namespace
