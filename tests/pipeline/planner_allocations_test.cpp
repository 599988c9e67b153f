// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Beside the mapper's own test of allocations, because the counting stands in this program.

#include <gtest/gtest.h>

#include <span>
#include <vector>

#include "support/allocations.hpp"
#include "support/hand_made_map.hpp"
#include "swiftlet/query/box_query.hpp"
#include "swiftlet/query/explore/frontier_map.hpp"
#include "swiftlet/query/explore/view_gain.hpp"
#include "swiftlet/query/ray_query.hpp"
#include "swiftlet/query/sweep/sweep.hpp"

namespace swiftlet {
namespace {

TEST(Planner, asks_for_points_rays_and_boxes_without_allocating) {
  test::HandMadeMap world(0.1, {8, 8, 3});
  world.fill({-3, -3, -1}, {3, 3, 1}, test::kFree);
  world.fill({1.5, -1, -1}, {1.6, 1, 1}, test::kOccupied);
  const MapSnapshot map = world.snapshot();
  const VoxelBox box = voxel_box_between({-2, -2, -1}, {2, 2, 1}, map.voxel_m());
  std::vector<float> probabilities(box.voxel_count());
  const Eigen::Vector3d here(-1, 0, 0), wall(1.55, 0, 0);

  const test::AllocationCount allocations;
  const Occupancy state = map.occupancy(wall);
  const double p = map.probability(here);
  const RayHit hit = cast_ray(map, here, wall);
  const VoxelCounts counts = count_voxels(map, box);
  copy_box(map, box, std::span<float>(probabilities));
  const std::size_t made = allocations.so_far();
  EXPECT_EQ(made, 0U);
  EXPECT_EQ(state, Occupancy::kOccupied);
  EXPECT_LT(p, 0.5);
  EXPECT_EQ(hit.state, Occupancy::kOccupied);
  EXPECT_GT(counts.free * counts.occupied, 0U);
}

TEST(Planner, asks_for_sweeps_frontiers_and_views_without_allocating) {
  test::HandMadeMap world(0.1, {8, 8, 3});
  world.fill({-3, -3, -1}, {3, 3, 1}, test::kFree);
  world.fill({1.5, -1, -1}, {1.6, 1, 1}, test::kOccupied);
  FrontierMap frontier;
  ViewGain gain;
  const auto T = Transform<World, Body>{} * forward_looking_camera();
  const auto body = BodyShape::box({0.6, 0.4, 0.2});
  const std::vector<Eigen::Vector3d> points{{-2, 0, 0}, {1, 1, 0}, {2, 0, 0}};
  const auto path = SweepPath::along(points);
  frontier.update(world.snapshot());
  const ViewCamera camera{.max_range_m = 3.0};
  ASSERT_GT(*gain.unknown_in_sight(world.snapshot(), T, camera), 0U);
  world.fill({-3.3, -3, -1}, {-3, 3, 1}, test::kFree);
  world.map().recentre({1.5, 0, 0}, nullptr);
  const MapSnapshot map = world.snapshot();

  const test::AllocationCount allocations;
  const auto answer = sweep(map, *body, *path, {.clearance_reach_m = 0.5});
  frontier.update(map);
  const auto unknown = gain.unknown_in_sight(map, T, camera);
  const std::size_t made = allocations.so_far();
  EXPECT_EQ(made, 0U);
  EXPECT_EQ(answer->state, SweepState::kBlocked);
  EXPECT_GT(frontier.voxel_count() * *unknown, 0U);
}

}  // namespace
}  // namespace swiftlet
