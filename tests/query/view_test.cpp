// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "support/hand_made_map.hpp"
#include "support/seeds.hpp"
#include "swiftlet/query/explore/frontier_clusters.hpp"
#include "swiftlet/query/explore/view_gain.hpp"
#include "swiftlet/query/explore/view_pose.hpp"

namespace swiftlet {
namespace {

using test::HandMadeMap;
using test::Random;

/// A room of 8 x 6 x 2.6 m, all seen but for the middle of one end.
void make_room(HandMadeMap& world) {
  world.fill({-4.05, -3.05, -1.35}, {4.05, 3.05, 1.35}, test::kOccupied);
  world.fill({-3.95, -2.95, -1.25}, {3.95, 2.95, 1.25}, test::kFree);
  world.fill({2.55, -1.45, -1.25}, {3.95, 1.45, 1.25}, kUnknownVoxel);
}

Transform<World, Camera> looking(double yaw_rad, const Eigen::Vector3d& p_world) {
  return Transform<World, Body>::trusted(
             Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), p_world) *
         forward_looking_camera();
}

FrontierClusters clusters_of(const MapSnapshot& map) {
  FrontierMap frontier;
  frontier.update(map);
  return cluster_frontier(frontier);
}

TEST(FindView, stands_where_the_body_is_clear_and_sees_the_cluster) {
  HandMadeMap world(0.1, {9, 7, 4});
  make_room(world);
  const MapSnapshot map = world.snapshot();
  const FrontierClusters found = clusters_of(map);
  ASSERT_GE(found.clusters.size(), 2U);
  const auto body = BodyShape::sphere(0.3);
  const ViewCamera camera;
  for (const FrontierCluster& cluster : found.clusters) {
    const auto voxels = found.voxels_of(cluster);
    const auto view = find_view(map, cluster, voxels, camera, *body);
    ASSERT_TRUE(view && *view);
    const TimedPose here{{}, (*view)->T_world_body};
    EXPECT_EQ(sweep(map, *body, *SweepPath::of({&here, 1}))->state, SweepState::kClear);
    EXPECT_GE((*view)->voxels_seen * 10, (*view)->voxels_tried * 7);
    const std::size_t seen = voxels_in_sight(
        map, voxels, (*view)->T_world_body * camera.T_body_camera, camera, OccupancyThresholds{});
    EXPECT_GE(seen * 10, voxels.size() * 6) << "most of the voxels that were not tried, too";
  }
}

TEST(FindView, finds_none_where_the_body_does_not_fit) {
  HandMadeMap world(0.1, {9, 7, 4});
  make_room(world);
  const MapSnapshot map = world.snapshot();
  const FrontierClusters found = clusters_of(map);
  const auto& cluster = found.clusters.front();
  const auto view = find_view(map, cluster, found.voxels_of(cluster), {}, *BodyShape::sphere(2.0));
  ASSERT_TRUE(view);
  EXPECT_FALSE(*view);
  EXPECT_FALSE(find_view(map, cluster, found.voxels_of(cluster), {.hfov_rad = 4.0},
                         *BodyShape::sphere(0.2)));
}

TEST(ViewGain, counts_unknown_voxels_in_the_image_up_to_the_first_wall) {
  HandMadeMap world(0.1, {9, 7, 4});
  make_room(world);
  const MapSnapshot map = world.snapshot();
  ViewGain gain;
  const ViewCamera camera{.max_range_m = 4.0};
  const auto at_it = gain.unknown_in_sight(map, looking(0.0, {0, 0, 0}), camera);
  const auto away = gain.unknown_in_sight(map, looking(3.14159, {0, 0, 0}), camera);
  ASSERT_TRUE(at_it && away);
  EXPECT_EQ(*away, 0U) << "all that is seen that way is known, and walls end the view";
  EXPECT_EQ(*at_it, 15U * 30U * 26U) << "the whole piece";
  const ViewCamera flat{.vfov_rad = 0.4, .max_range_m = 4.0};
  const double part = static_cast<double>(*gain.unknown_in_sight(map, looking(0, {0, 0, 0}), flat));
  // 2 tan(0.2) of the distance is in sight of its 2.6 m: at 2.5 m 39 %, at 4 m 62 %.
  EXPECT_NEAR(part / (15.0 * 30.0 * 26.0), 0.53, 0.04);
}

/// How many unknown voxels have a point in the image with nothing occupied on the ray to it, of a
/// grid of points in each voxel, 1 (its middle) or 3 a side.
std::size_t gain_by_hand(const MapSnapshot& map, const Transform<World, Camera>& T,
                         const ViewCamera& camera, int points) {
  std::size_t count = 0;
  const VoxelBox window = voxel_box(map.window());
  const auto T_camera_world = T.inverse();
  const auto is_in_sight = [&](const VoxelIndex& v) {
    for (int i = 0; i < points * points * points; ++i) {
      const Eigen::Vector3d at(i % points, i / points % points, i / points / points);
      const Eigen::Vector3d off = 0.49 * (at.array() - 0.5 * (points - 1)).matrix();
      const Eigen::Vector3d p_world = centre_of(v, map.voxel_m()) + off * map.voxel_m();
      if (!camera.covers(T_camera_world * p_world)) continue;
      const RayHit hit = cast_ray(map, T.translation(), p_world, {}, UnknownSpace::kPasses);
      if (hit.state == Occupancy::kFree) return true;
    }
    return false;
  };
  for (VoxelIndex v = window.first; v.z <= window.last.z; ++v.z) {
    for (v.y = window.first.y; v.y <= window.last.y; ++v.y) {
      for (v.x = window.first.x; v.x <= window.last.x; ++v.x)
        count += map.log_odds(v) == kUnknownVoxel && is_in_sight(v) ? 1 : 0;
    }
  }
  return count;
}

TEST(ViewGain, lies_between_the_voxels_whose_middle_and_those_of_which_any_part_is_in_sight) {
  Random random;
  for (int i = 0; i < 8; ++i) {
    HandMadeMap world(0.1, {5, 5, 3});
    for (int k = 0; k < 25; ++k) {
      const Eigen::Vector3d a = random.vector(-2.4, 2.0);
      world.fill(a, a + random.vector(0.1, 1.2),
                 random.chance(0.3) ? test::kOccupied : test::kFree);
    }
    const MapSnapshot map = world.snapshot();
    const ViewCamera camera{.max_range_m = 2.0};
    const auto T = Transform<World, Camera>::trusted(random.rotation(), random.vector(-1, 1));
    ViewGain gain;
    const auto count = gain.unknown_in_sight(map, T, camera);
    ASSERT_TRUE(count);
    // Rays go a voxel apart and points half a voxel: a few voxels of a hundred slip through either.
    EXPECT_GE(static_cast<double>(*count),
              0.95 * static_cast<double>(gain_by_hand(map, T, camera, 1)))
        << random.repeat();
    EXPECT_LE(static_cast<double>(*count),
              1.05 * static_cast<double>(gain_by_hand(map, T, camera, 3)) + 10.0)
        << random.repeat();
    EXPECT_EQ(*gain.unknown_in_sight(map, T, camera), *count) << "asked again";
  }
}

TEST(ViewGain, refuses_what_is_no_camera_or_no_place) {
  HandMadeMap world(0.1, {2, 2, 2});
  const MapSnapshot map = world.snapshot();
  ViewGain gain;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(gain.unknown_in_sight(map, looking(0, {kNan, 0, 0}), {}));
  EXPECT_FALSE(gain.unknown_in_sight(map, looking(0, {0, 0, 0}), {.hfov_rad = kNan}));
  EXPECT_FALSE(gain.unknown_in_sight(map, looking(0, {0, 0, 0}), {.vfov_rad = 3.1}));
  EXPECT_FALSE(gain.unknown_in_sight(map, looking(0, {0, 0, 0}), {.max_range_m = 0.0}));
  EXPECT_EQ(*gain.unknown_in_sight(map, looking(0, {900, 0, 0}), {}), 0U);
}

}  // namespace
}  // namespace swiftlet
