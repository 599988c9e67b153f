// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/ray_query.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/seeds.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/query/occupancy_query.hpp"
#include "swiftlet/query/voxel_counts.hpp"

namespace swiftlet {
namespace {

using test::Random;
constexpr OccupancyThresholds kThresholds{};
constexpr double kVoxel_m = 0.25;

RollingMap random_map(Random& random) {
  auto map = RollingMap::create({.voxel_m = kVoxel_m, .size_m = {6, 6, 3}, .trigger_m = {1, 1, 1}});
  map->recentre(Eigen::Vector3d::Zero(), nullptr);
  for_each_block(map->window(), [&](const BlockIndex& b) {
    if (random.chance(0.2)) return;
    for (QuantizedLogOdds& voxel : map->writable(b).voxels) {
      voxel = random.chance(0.03) ? 200 : random.chance(0.03) ? kUnknownVoxel : 20;
    }
  });
  return std::move(*map);
}

/// The first voxel along the way that is not free, found by walking in steps of a thousandth of a
/// voxel.
RayHit walk(const MapSnapshot& map, const Eigen::Vector3d& from, const Eigen::Vector3d& to,
            UnknownSpace unknown) {
  const double length = (to - from).norm();
  const int steps = static_cast<int>(length / kVoxel_m * 1000.0) + 1;
  for (int i = 0; i <= steps; ++i) {
    const double t = static_cast<double>(i) / steps;
    const Eigen::Vector3d p = from + t * (to - from);
    const Occupancy state = occupancy_at(map, p, kThresholds);
    const bool stops = state == Occupancy::kOccupied ||
                       (state == Occupancy::kUnknown && unknown == UnknownSpace::kStops);
    if (stops) return {state, t * length, voxel_containing(p, kVoxel_m)};
  }
  return {Occupancy::kFree, length, voxel_containing(to, kVoxel_m)};
}

TEST(CastRay, finds_what_a_walk_in_tiny_steps_finds) {
  Random random;
  RollingMap map = random_map(random);
  const auto snapshot = map.snapshot({1});
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const Eigen::Vector3d from = random.vector(-4.5, 4.5), to = random.vector(-4.5, 4.5);
    const auto unknown = random.chance(0.5) ? UnknownSpace::kStops : UnknownSpace::kPasses;
    const RayHit hit = cast_ray(*snapshot, from, to, kThresholds, unknown);
    const RayHit expected = walk(*snapshot, from, to, unknown);
    // The walk may step over a corner of less than a thousandth of a voxel; then ours is nearer,
    // and that voxel real.
    if (hit.distance_m < expected.distance_m - 2e-3 * kVoxel_m) {
      ASSERT_EQ(kThresholds.classify(snapshot->log_odds(hit.voxel)), hit.state) << random.repeat();
      continue;
    }
    ++compared;
    ASSERT_NEAR(hit.distance_m, expected.distance_m, 2e-3 * kVoxel_m) << random.repeat();
    ASSERT_EQ(hit.state == Occupancy::kFree, expected.state == Occupancy::kFree) << random.repeat();
  }
  EXPECT_GT(compared, 370);
}

TEST(CastRay, calls_space_outside_the_window_unknown) {
  Random random;
  RollingMap map = random_map(random);
  const auto snapshot = map.snapshot({1});
  const RayHit outside = cast_ray(*snapshot, {100, 0, 0}, {0, 0, 0}, kThresholds);
  EXPECT_EQ(outside.state, Occupancy::kUnknown);
  EXPECT_EQ(outside.distance_m, 0.0);
  EXPECT_EQ(cast_ray(*snapshot, {100, 0, 0}, {200, 0, 0}, kThresholds, UnknownSpace::kPasses).state,
            Occupancy::kFree);
}

TEST(CountVoxels, counts_every_voxel_of_the_known_blocks_once) {
  Random random;
  RollingMap map = random_map(random);
  const auto snapshot = map.snapshot({1});
  std::size_t blocks = 0, occupied = 0;
  snapshot->for_each_known_block([&](const BlockIndex&, const VoxelBlock& block) {
    ++blocks;
    occupied += static_cast<std::size_t>(std::ranges::count(block.voxels, 200));
  });
  const VoxelCounts counts = count_voxels(*snapshot, kThresholds);
  EXPECT_EQ(counts.free + counts.unknown + counts.occupied, blocks * kBlockVoxels);
  EXPECT_EQ(counts.occupied, occupied);
}

}  // namespace
}  // namespace swiftlet
