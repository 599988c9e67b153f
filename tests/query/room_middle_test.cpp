// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/explore/room_middle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/hand_made_map.hpp"
#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::HandMadeMap;
using test::Random;

constexpr double kPlanVoxel_m = 0.1;

/// A box of space, turned about the vertical.
struct Room {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  Eigen::Vector2d half{1, 1};
  double yaw_rad = 0.0;

  [[nodiscard]] bool contains(const Eigen::Vector3d& p) const {
    const Eigen::Vector2d q = Eigen::Rotation2Dd(-yaw_rad) * (p.head<2>() - middle);
    return (q.array().abs() <= half.array()).all();
  }
};

template <class IsAir>
void carve(HandMadeMap& world, IsAir&& is_air) {
  const VoxelBox box = voxel_box(world.map().window());
  for (VoxelIndex v = box.first; v.z <= box.last.z; ++v.z) {
    for (v.y = box.first.y; v.y <= box.last.y; ++v.y) {
      for (v.x = box.first.x; v.x <= box.last.x; ++v.x) {
        if (is_air(centre_of(v, kPlanVoxel_m))) world.set(v, test::kFree);
      }
    }
  }
}

/// What a turn in place shows of another map, far enough all around.
void look_around(const MapSnapshot& truth, const Eigen::Vector3d& p_world, HandMadeMap& seen) {
  for (int i = 0; i < 2000; ++i) {
    const double yaw_rad = 2.0 * std::numbers::pi * i / 2000;
    const Eigen::Vector3d beam(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
    const RayHit hit = cast_ray(truth, p_world, p_world + 8.0 * beam, {});
    for (double at_m = 0.0; at_m < hit.distance_m; at_m += 0.05) {
      for (double z = -0.4; z < 0.45; z += 0.1)
        seen.set_at(p_world + at_m * beam + Eigen::Vector3d(0, 0, z), test::kFree);
    }
  }
}

TEST(RoomMiddle, is_that_of_a_rectangle_wherever_the_vehicle_is_in_it) {
  Random random;
  for (int i = 0; i < 100; ++i) {
    HandMadeMap world(kPlanVoxel_m, {10, 10, 1});
    Room room{random.vector(-1, 1).head<2>(),
              {random.real(0.8, 3.5), random.real(0.8, 3.0)},
              random.real(0.0, 3.0)};
    carve(world, [&](const Eigen::Vector3d& p) { return room.contains(p); });
    const Eigen::Vector2d inside = 0.8 * room.half.cwiseProduct(random.vector(-1, 1).head<2>());
    const Eigen::Vector2d at = room.middle + Eigen::Rotation2Dd(room.yaw_rad) * inside;
    const auto found = room_middle(world.snapshot(), {at.x(), at.y(), 0.0});
    ASSERT_TRUE(found && *found) << random.repeat() << ", room " << i;
    EXPECT_LT(((*found)->p_world.head<2>() - room.middle).norm(), 0.3)
        << random.repeat() << ", room " << i;
    EXPECT_LE((*found)->clearance_m, room.half.minCoeff());
    EXPECT_GT((*found)->clearance_m, room.half.minCoeff() - 0.35);
  }
}

TEST(RoomMiddle, of_ten_offices_is_found_after_one_turn_in_place) {
  Random random;
  for (int office = 0; office < 10; ++office) {
    // Two rooms beside each other and a corridor before them, with doors of 0.9 m.
    const double width = random.real(2.6, 4.5), depth = random.real(3.0, 5.0);
    const Room here{{-0.5 * width - 0.1, 1.0}, {0.5 * width, 0.5 * depth}};
    const Room beside{{0.5 * width + 0.1, 1.0}, {0.5 * width, 0.5 * depth}};
    const double front = 1.0 - 0.5 * depth;
    const Room corridor{{0.0, front - 0.9}, {4.5, 0.7}};
    const Room door{{0.0, random.real(0.4, 1.6)}, {0.2, 0.45}};
    const Room way_out{{-0.5 * width, front - 0.1}, {0.45, 0.2}};
    HandMadeMap truth(kPlanVoxel_m, {10, 10, 1});
    truth.fill_window(test::kOccupied);
    carve(truth, [&](const Eigen::Vector3d& p) {
      return here.contains(p) || beside.contains(p) || corridor.contains(p) || door.contains(p) ||
             way_out.contains(p);
    });
    HandMadeMap seen(kPlanVoxel_m, {10, 10, 1});
    const Eigen::Vector2d at =
        here.middle + 0.5 * here.half.cwiseProduct(random.vector(-1, 1).head<2>());
    look_around(truth.snapshot(), {at.x(), at.y(), 0.0}, seen);
    const auto found = room_middle(seen.snapshot(), {at.x(), at.y(), 0.0});
    ASSERT_TRUE(found && *found) << random.repeat() << ", office " << office;
    EXPECT_LT(((*found)->p_world.head<2>() - here.middle).norm(), 0.3)
        << random.repeat() << ", office " << office;
  }
}

TEST(RoomMiddle, stays_in_a_room_that_is_bent) {
  HandMadeMap world(kPlanVoxel_m, {10, 10, 1});
  const Room along_x{{0.0, -2.0}, {3.0, 0.8}}, along_y{{-2.2, 0.0}, {0.8, 2.8}};
  carve(world,
        [&](const Eigen::Vector3d& p) { return along_x.contains(p) || along_y.contains(p); });
  const auto found = room_middle(world.snapshot(), {2.0, -2.0, 0.0});
  ASSERT_TRUE(found && *found);
  EXPECT_TRUE(along_x.contains((*found)->p_world) || along_y.contains((*found)->p_world));
  EXPECT_GT((*found)->clearance_m, 0.5);
}

TEST(RoomMiddle, is_none_where_there_is_no_room) {
  HandMadeMap world(kPlanVoxel_m, {4, 4, 1});
  carve(world, [](const Eigen::Vector3d& p) { return std::abs(p.y()) < 0.3; });
  const MapSnapshot map = world.snapshot();
  EXPECT_FALSE(*room_middle(map, {0, 0, 0}));
  EXPECT_TRUE(*room_middle(map, {0, 0, 0}, {.door_m = 0.3}));
  EXPECT_FALSE(*room_middle(map, {0, 1.0, 0}, {.door_m = 0.3})) << "in the unknown";
  EXPECT_FALSE(*room_middle(map, {100, 0, 0})) << "outside";
  EXPECT_FALSE(room_middle(map, {std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  EXPECT_FALSE(room_middle(map, {0, 0, 0}, {.door_m = -1.0}));
}

}  // namespace
}  // namespace swiftlet
