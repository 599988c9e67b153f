// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/hand_made_map.hpp"
#include "support/seeds.hpp"
#include "swiftlet/query/explore/frontier_clusters.hpp"
#include "swiftlet/query/occupancy_query.hpp"

namespace swiftlet {
namespace {

using test::HandMadeMap;
using test::Random;
using Voxels = std::set<VoxelIndex>;

/// Every voxel of the window, looked at one by one.
Voxels frontier_by_hand(const MapSnapshot& map, const OccupancyThresholds& thresholds) {
  Voxels found;
  const VoxelBox window = voxel_box(map.window());
  const auto is = [&](const VoxelIndex& v, Occupancy state) {
    return window.contains(v) && thresholds.classify(map.log_odds(v)) == state;
  };
  for (VoxelIndex v = window.first; v.z <= window.last.z; ++v.z) {
    for (v.y = window.first.y; v.y <= window.last.y; ++v.y) {
      for (v.x = window.first.x; v.x <= window.last.x; ++v.x) {
        if (!is(v, Occupancy::kFree)) continue;
        const bool is_frontier = is({v.x - 1, v.y, v.z}, Occupancy::kUnknown) ||
                                 is({v.x + 1, v.y, v.z}, Occupancy::kUnknown) ||
                                 is({v.x, v.y - 1, v.z}, Occupancy::kUnknown) ||
                                 is({v.x, v.y + 1, v.z}, Occupancy::kUnknown) ||
                                 is({v.x, v.y, v.z - 1}, Occupancy::kUnknown) ||
                                 is({v.x, v.y, v.z + 1}, Occupancy::kUnknown);
        if (is_frontier) found.insert(v);
      }
    }
  }
  return found;
}

Voxels voxels_of(const FrontierMap& frontier) {
  Voxels voxels;
  frontier.for_each_voxel([&](const VoxelIndex& v) { voxels.insert(v); });
  EXPECT_EQ(voxels.size(), frontier.voxel_count());
  return voxels;
}

/// A few boxes of random belief, as frames bring them.
void change_something(RollingMap& map, Random& random) {
  const VoxelBox window = voxel_box(map.window());
  for (int i = random.integer(0, 4); i > 0; --i) {
    const VoxelIndex a{random.integer(window.first.x, window.last.x),
                       random.integer(window.first.y, window.last.y),
                       random.integer(window.first.z, window.last.z)};
    const int edge = random.integer(1, 12);
    const bool is_noise = random.chance(0.3);
    const auto value = static_cast<QuantizedLogOdds>(random.integer(0, 255));
    for (VoxelIndex v = a; v.z <= std::min(a.z + edge, window.last.z); ++v.z) {
      for (v.y = a.y; v.y <= std::min(a.y + edge, window.last.y); ++v.y) {
        for (v.x = a.x; v.x <= std::min(a.x + edge, window.last.x); ++v.x) {
          map.writable(block_of(v)).voxels[offset_in_block(v)] =
              is_noise ? static_cast<QuantizedLogOdds>(random.integer(0, 255)) : value;
        }
      }
    }
  }
}

TEST(Frontier, is_what_a_search_of_all_voxels_finds_after_every_frame_and_move) {
  Random random;
  std::size_t most_voxels = 0;
  for (int flight = 0; flight < 6; ++flight) {
    HandMadeMap world(0.1, {2.4, 1.6, 1.0});
    OccupancyThresholds thresholds;
    if (flight >= 3) thresholds = {random.integer(1, 127), random.integer(128, 255)};
    FrontierMap frontier(thresholds);
    Eigen::Vector3d vehicle(0, 0, 0);
    for (int frame = 0; frame < 60; ++frame) {
      const double step = random.chance(0.1) ? 6.0 : 0.7;
      if (random.chance(0.5)) vehicle += random.vector(-step, step);
      world.map().recentre(vehicle, nullptr);
      change_something(world.map(), random);
      const MapSnapshot map = world.snapshot();
      if (random.chance(0.2)) continue;  // a reader that was late
      frontier.update(map);
      ASSERT_EQ(voxels_of(frontier), frontier_by_hand(map, thresholds))
          << random.repeat() << ", flight " << flight << ", frame " << frame;
      most_voxels = std::max(most_voxels, frontier.voxel_count());
    }
  }
  EXPECT_GT(most_voxels, 100U);
}

TEST(Frontier, costs_what_changed) {
  HandMadeMap world(0.1, {8, 8, 4});
  world.fill({-2, -2, -1}, {2, 2, 1}, test::kFree);
  FrontierMap frontier;
  frontier.update(world.snapshot());
  const FrontierMap::Work nothing = frontier.update(world.snapshot());
  EXPECT_EQ(nothing.blocks_changed + nothing.blocks_searched, 0U);
  world.set_at({0.05, 0.05, 0.05}, test::kOccupied);
  const FrontierMap::Work one = frontier.update(world.snapshot());
  EXPECT_EQ(one.blocks_changed, 1U);
  EXPECT_EQ(one.blocks_searched, 7U);
  world.set_at({1.05, 0.05, 0.05}, test::kFree + 1);  // another byte, still free
  EXPECT_EQ(frontier.update(world.snapshot()).blocks_changed, 0U);
}

TEST(Frontier, begins_again_with_another_map) {
  HandMadeMap first(0.1, {4, 4, 2}), second(0.1, {4, 4, 2});
  FrontierMap frontier;
  first.fill({-1, -1, -1}, {1, 1, 1}, test::kFree);
  for (int i = 0; i < 3; ++i) frontier.update(first.snapshot());
  second.fill({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}, test::kFree);
  const MapSnapshot map = second.snapshot();
  frontier.update(map);
  EXPECT_EQ(voxels_of(frontier), frontier_by_hand(map, {}));
}

TEST(FrontierClusters, have_their_middle_size_and_a_normal_into_the_unknown) {
  HandMadeMap world(0.1, {8, 8, 4});
  world.fill_window(test::kOccupied);
  world.fill({-2.95, -0.95, -0.45}, {2.95, 0.95, 0.45}, test::kFree);   // a corridor along x,
  world.fill({3.05, -0.95, -0.45}, {3.45, 0.95, 0.45}, kUnknownVoxel);  // open at its end
  FrontierMap frontier;
  frontier.update(world.snapshot());
  const FrontierClusters found = cluster_frontier(frontier);
  ASSERT_EQ(found.clusters.size(), 1U);
  const FrontierCluster& end = found.clusters.front();
  EXPECT_EQ(end.voxel_count, 20U * 10U);
  EXPECT_NEAR((end.centroid_m - Eigen::Vector3d(2.95, 0.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_EQ(end.normal, Eigen::Vector3d::UnitX());
  EXPECT_TRUE(cluster_frontier(frontier, {.min_voxels = 201}).clusters.empty());
}

TEST(FrontierClusters, hold_every_voxel_once_and_none_is_larger_than_asked_for) {
  Random random;
  HandMadeMap world(0.1, {4, 4, 2});
  for (int i = 0; i < 10; ++i) change_something(world.map(), random);
  FrontierMap frontier;
  frontier.update(world.snapshot());
  const FrontierClusters found = cluster_frontier(frontier, {.max_extent_m = 0.5, .min_voxels = 1});
  EXPECT_EQ(Voxels(found.voxels.begin(), found.voxels.end()), voxels_of(frontier))
      << random.repeat();
  EXPECT_EQ(found.voxels.size(), frontier.voxel_count());
  EXPECT_GT(found.clusters.size(), 3U);
  for (const FrontierCluster& cluster : found.clusters) {
    const auto voxels = found.voxels_of(cluster);
    VoxelBox box{voxels.front(), voxels.front()};
    for (const VoxelIndex& v : voxels) box.include(v);
    EXPECT_LT(box.last.x - box.first.x, 5);
    EXPECT_LT(box.last.y - box.first.y, 5);
    EXPECT_LT(box.last.z - box.first.z, 5);
  }
}

}  // namespace
}  // namespace swiftlet
