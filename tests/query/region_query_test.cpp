// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/region_query.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "support/hand_made_map.hpp"
#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::HandMadeMap;
using test::Random;

constexpr double kRegionVoxel_m = 0.1;

Transform<World, Body> at(const Eigen::Vector3d& p_world) {
  return Transform<World, Body>::trusted(Eigen::Quaterniond::Identity(), p_world);
}

/// A random belief in every voxel.
void fill_with_everything(HandMadeMap& world, Random& random) {
  constexpr std::array<QuantizedLogOdds, 3> kValues{test::kFree, kUnknownVoxel, test::kOccupied};
  const VoxelBox box = voxel_box(world.map().window());
  for (VoxelIndex v = box.first; v.z <= box.last.z; ++v.z) {
    for (v.y = box.first.y; v.y <= box.last.y; ++v.y) {
      for (v.x = box.first.x; v.x <= box.last.x; ++v.x)
        world.set(v, kValues[random.integer<std::size_t>(0, 2)]);
    }
  }
}

TEST(VoxelsInBody, counts_the_voxels_of_spheres_and_boxes_as_plain_geometry_does) {
  Random random;
  HandMadeMap world(kRegionVoxel_m, {3, 3, 2});
  fill_with_everything(world, random);
  const MapSnapshot map = world.snapshot();
  const VoxelBox window = voxel_box(map.window());
  for (int i = 0; i < 40; ++i) {
    const bool is_sphere = i % 2 == 0;
    const Eigen::Vector3d p = random.vector(-1.0, 1.0), half = random.vector(0.05, 0.6);
    const auto body = is_sphere ? BodyShape::sphere(half.x()) : BodyShape::box(2.0 * half);
    const auto region = voxels_in_body(map, *body, at(p));
    ASSERT_TRUE(region);
    VoxelCounts expected;
    for (VoxelIndex v = window.first; v.z <= window.last.z; ++v.z) {
      for (v.y = window.first.y; v.y <= window.last.y; ++v.y) {
        for (v.x = window.first.x; v.x <= window.last.x; ++v.x) {
          const Eigen::Array3d off =
              ((centre_of(v, kRegionVoxel_m) - p).array().abs() - 0.5 * kRegionVoxel_m).max(0.0);
          const bool touches =
              is_sphere ? off.matrix().norm() <= half.x() : (off <= half.array()).all();
          if (!touches) continue;
          const Occupancy state = OccupancyThresholds{}.classify(map.log_odds(v));
          ++(state == Occupancy::kFree      ? expected.free
             : state == Occupancy::kUnknown ? expected.unknown
                                            : expected.occupied);
        }
      }
    }
    EXPECT_EQ(region->counts.free, expected.free) << random.repeat();
    EXPECT_EQ(region->counts.unknown, expected.unknown) << random.repeat();
    EXPECT_EQ(region->counts.occupied, expected.occupied) << random.repeat();
  }
}

TEST(VoxelsInBody, finds_the_nearest_voxel_that_is_not_free_and_counts_a_union_once) {
  HandMadeMap world(kRegionVoxel_m, {3, 3, 2});
  world.fill_window(test::kFree);
  world.set_at({0.55, 0.05, 0.05}, kUnknownVoxel);
  world.set_at({-0.35, 0.05, 0.05}, test::kOccupied);
  const MapSnapshot map = world.snapshot();
  const auto sphere = BodyShape::sphere(0.8);
  const std::array<BodyShape, 2> twice{*sphere, *sphere};
  const auto once = voxels_in_body(map, *sphere, at({0.05, 0.05, 0.05}));
  EXPECT_EQ(*once->first_not_free, voxel_containing({-0.35, 0.05, 0.05}, kRegionVoxel_m));
  EXPECT_EQ(once->counts.occupied + once->counts.unknown, 2U);
  EXPECT_FALSE(once->is_free());
  const auto both = voxels_in_body(map, *BodyShape::united(twice), at({0.05, 0.05, 0.05}));
  EXPECT_EQ(both->counts.free, once->counts.free);
  EXPECT_TRUE(voxels_in_body(map, *BodyShape::sphere(0.2), at({0.05, 0.05, 0.05}))->is_free());
  EXPECT_FALSE(voxels_in_body(map, *BodyShape::sphere(0.2), at({1.9, 0, 0}))->is_inside);
  EXPECT_FALSE(voxels_in_body(map, *sphere, at({std::nan(""), 0, 0})));
}

TEST(VoxelsInCone, holds_every_voxel_of_the_cone_and_none_that_is_a_diagonal_away) {
  Random random;
  HandMadeMap world(kRegionVoxel_m, {4, 4, 2});
  for (int i = 0; i < 400; ++i) {
    const ConeRegion cone{random.vector(-0.5, 0.5), random.vector(-1, 1), random.real(0.1, 1.2),
                          random.real(0.2, 0.8)};
    const Eigen::Vector3d axis = cone.axis_world.normalized();
    // Near enough: some point of a fine grid of the cone is.
    const auto is_near = [&](const Eigen::Vector3d& p, double near_m) {
      const Eigen::Vector3d d = p - cone.tip_world;
      const double beside = (d - d.dot(axis) * axis).norm();
      for (int k = 0; k <= 200; ++k) {
        const double along = cone.length_m * k / 200;
        const double radius = along * std::tan(cone.half_angle_rad);
        const double off = std::hypot(d.dot(axis) - along, std::max(0.0, beside - radius));
        if (off <= near_m) return true;
      }
      return false;
    };
    world.fill_window(test::kFree);
    const Eigen::Vector3d p = random.vector(-1.0, 1.0);
    world.set_at(p, test::kOccupied);
    const auto region = voxels_in_cone(world.snapshot(), cone);
    ASSERT_TRUE(region);
    if (is_near(p, 0.0005)) {
      EXPECT_EQ(region->counts.occupied, 1U) << random.repeat();
    } else if (!is_near(p, 1.05 * std::sqrt(3.0) * kRegionVoxel_m)) {
      EXPECT_EQ(region->counts.occupied, 0U) << random.repeat();
    }
  }
  const MapSnapshot map = world.snapshot();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(voxels_in_cone(map, {{0, 0, 0}, {0, 0, 0}, 0.5, 1.0}));
  EXPECT_FALSE(voxels_in_cone(map, {{0, 0, 0}, {1, 0, 0}, 1.6, 1.0}));
  EXPECT_FALSE(voxels_in_cone(map, {{0, 0, 0}, {1, 0, 0}, 0.5, kNan}));
  EXPECT_FALSE(voxels_in_cone(map, {{0, 0, 0}, {1, 0, 0}, 0.5, 3.0})->is_inside);
}

}  // namespace
}  // namespace swiftlet
