// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What a distance field answers, against geometry and the bounds of the docs.

#include <gtest/gtest.h>

#include "query/restless_map.hpp"
#include "support/brute_distance.hpp"

namespace swiftlet {
namespace {

using test::any_voxel;
using test::BruteDistance;
using test::field_for;
using test::kBothObstacles;
using test::kRestlessVoxel_m;
using test::Random;
using test::RestlessMap;

TEST(DistanceField, knows_a_wall_and_a_ball_within_the_diagonal_of_a_voxel) {
  auto map = RollingMap::create({.voxel_m = 0.1, .size_m = {6, 6, 6}});
  map->recentre(Eigen::Vector3d::Zero(), nullptr);
  const double wall_x_m = 2.0, radius_m = 0.8;
  for_each_block(map->window(), [&](const BlockIndex& b) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      const Eigen::Vector3d p = centre_of(voxel_at(b, i), 0.1);
      map->writable(b).voxels[i] = p.x() > wall_x_m || p.norm() < radius_m ? 220 : 20;
    }
  });
  DistanceField field = field_for(*map, {.max_distance_m = 1.5, .is_signed = true});
  field.update(*map->snapshot({1}));
  Random random;
  int compared = 0;
  for (int i = 0; i < 5000; ++i) {
    const Eigen::Vector3d p = random.vector(-2.4, 2.4);
    const double true_m = std::min(wall_x_m - p.x(), p.norm() - radius_m);
    const DistanceSample sample = field.sample(p, Obstacles::kOccupied);
    if (sample.status != DistanceStatus::kKnown || true_m > 1.2 || true_m < -0.6) continue;
    // The centre of the obstacle that counts is at most half a diagonal below the true surface of
    // what was filled, and half a diagonal from the nearest point of that; 4 mm for the curvature
    // of the ball between two centres.
    ASSERT_NEAR(sample.distance_m, true_m, std::sqrt(3.0) * 0.1 + 4e-3) << p.transpose();
    ++compared;
  }
  EXPECT_GT(compared, 1000);
}

TEST(DistanceField, has_the_gradient_of_its_values_and_no_steps_in_them) {
  Random random;
  RestlessMap world(random, {6, 6, 4});
  for (const bool is_signed : {false, true}) {
    DistanceField field = field_for(world.map(), {.max_distance_m = 1.6, .is_signed = is_signed});
    const MapSnapshot map = world.changed();
    field.update(map);
    const VoxelBox box = voxel_box(field.box());
    const auto any_place = [&](double rim) {
      return Eigen::Vector3d(random.real(box.first.x + rim, box.last.x + 1 - rim),
                             random.real(box.first.y + rim, box.last.y + 1 - rim),
                             random.real(box.first.z + rim, box.last.z + 1 - rim));
    };
    for (int i = 0; i < 3000; ++i) {
      const Obstacles obstacles = kBothObstacles[i % 2];
      Eigen::Vector3d p = any_place(0.02);
      // Between eight centres the value is a polynomial; keep the differences between them.
      for (double& v : p) {
        const double t = v - 0.5 - std::floor(v - 0.5);
        if (t < 1e-3 || t > 1 - 1e-3) v += 4e-3;
      }
      const DistanceSample here = field.sample(p * kRestlessVoxel_m, obstacles);
      Eigen::Vector3d slope;
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d step = Eigen::Vector3d::Unit(axis) * 1e-4 * kRestlessVoxel_m;
        slope[axis] = (field.sample(p * kRestlessVoxel_m + step, obstacles).distance_m -
                       field.sample(p * kRestlessVoxel_m - step, obstacles).distance_m) /
                      (2e-4 * kRestlessVoxel_m);
      }
      // Trilinear is linear along each axis, so all that is left is rounding: 1e-16 / 1e-5.
      ASSERT_LT((slope - here.gradient).norm(), 1e-8);
      // No steps: a Lipschitz constant of sqrt(3), also across the seams between eight centres.
      const Eigen::Vector3d q = p + random.vector(-0.01, 0.01);
      const DistanceSample there = field.sample(q * kRestlessVoxel_m, obstacles);
      ASSERT_LE(std::abs(there.distance_m - here.distance_m),
                std::sqrt(3.0) * (q - p).norm() * kRestlessVoxel_m + 1e-9);
    }
  }
}

// The bound of the docs, against the boxes that the voxels are.
TEST(DistanceField, never_claims_more_room_than_its_margin_allows) {
  Random random;
  RestlessMap world(random, {5, 5, 3});
  DistanceField field = field_for(world.map(), {.max_distance_m = 1.5});
  BruteDistance truth(8.0);
  int tight = 0;
  for (int round = 0; round < 20; ++round) {
    const MapSnapshot map = world.changed();
    field.update(map);
    truth.look(map, field.box(), {});
    for (int i = 0; i < 100; ++i) {
      const VoxelIndex v = any_voxel(random, field.box());
      const Eigen::Vector3d p = Eigen::Vector3d(v.x, v.y, v.z) + random.vector(0, 1);
      for (const Obstacles obstacles : kBothObstacles) {
        double true_voxels = 1e9;
        for (int z = -7; z <= 7; ++z)
          for (int y = -7; y <= 7; ++y)
            for (int x = -7; x <= 7; ++x) {
              if (!truth.is_obstacle({v.x + x, v.y + y, v.z + z}, obstacles)) continue;
              const Eigen::Vector3d low(v.x + x, v.y + y, v.z + z);
              const Eigen::Vector3d in = p.cwiseMax(low).cwiseMin(low + Eigen::Vector3d::Ones());
              true_voxels = std::min(true_voxels, (p - in).norm());
            }
        const double margin_m = field.conservative_margin_m();
        const double claimed_m =
            field.sample(p * kRestlessVoxel_m, obstacles).distance_m - margin_m;
        ASSERT_LE(claimed_m, true_voxels * kRestlessVoxel_m + 1e-6);
        ASSERT_LE(field.distance(v, obstacles).distance_m - margin_m,
                  true_voxels * kRestlessVoxel_m + 1e-6);
        tight += claimed_m > 0.5 * true_voxels * kRestlessVoxel_m ? 1 : 0;
      }
    }
  }
  EXPECT_GT(tight, 10);
}

TEST(DistanceField, says_what_an_answer_is_worth) {
  auto map = RollingMap::create({.voxel_m = kRestlessVoxel_m, .size_m = {6, 6, 6}});
  map->recentre(Eigen::Vector3d::Zero(), nullptr);
  for (const BlockIndex b : {BlockIndex{0, 0, 0}, BlockIndex{-1, 0, 0}}) {
    map->writable(b).voxels.fill(20);
  }
  map->writable({0, 0, 0}).voxels[offset_in_block({7, 4, 4})] = 220;
  DistanceField field = field_for(*map, {.max_distance_m = 1.0});
  constexpr auto kOccupied = Obstacles::kOccupied, kNotFree = Obstacles::kNotFree;
  EXPECT_EQ(field.distance({0, 0, 0}, kOccupied).status, DistanceStatus::kOutside) << "no map yet";
  field.update(*map->snapshot({1}));
  EXPECT_EQ(field.distance({5, 4, 4}, kOccupied).status, DistanceStatus::kKnown);
  EXPECT_EQ(field.distance({5, 4, 4}, kOccupied).distance_m, 2 * kRestlessVoxel_m);
  EXPECT_EQ(field.distance({-2, 4, 4}, kOccupied).status, DistanceStatus::kBeyondReach);
  EXPECT_EQ(field.distance({-2, 4, 4}, kOccupied).distance_m, 1.0);
  EXPECT_EQ(field.distance({8, 4, 4}, kOccupied).status, DistanceStatus::kUnknownHere);
  EXPECT_EQ(field.distance({8, 4, 4}, kOccupied).distance_m, kRestlessVoxel_m);
  EXPECT_EQ(field.distance({8, 4, 4}, kNotFree).distance_m, 0.0);
  EXPECT_EQ(field.distance({4000, 4, 4}, kNotFree).status, DistanceStatus::kOutside);
  EXPECT_FALSE(field.closest_obstacle({4000, 4, 4}, kNotFree));
  const double not_a_number = std::nan("");
  for (const Eigen::Vector3d& p : {Eigen::Vector3d(1e300, 0, 0), Eigen::Vector3d(-1e12, 0, 0),
                                   Eigen::Vector3d(0, not_a_number, 0)}) {
    EXPECT_EQ(field.sample(p, kOccupied).status, DistanceStatus::kOutside);
  }
  EXPECT_EQ(field.sample({-0.3, 1, 1}, kOccupied).status, DistanceStatus::kBeyondReach);
}

TEST(DistanceField, refuses_what_it_cannot_be) {
  const auto error_of = [](const DistanceFieldOptions& options, double voxel_m = 0.1) {
    const auto field = DistanceField::create(voxel_m, {4, 4, 4}, options);
    return field ? std::string("none") : field.error().text();
  };
  const double not_a_number = std::nan("");
  EXPECT_EQ(error_of({}), "none");
  EXPECT_EQ(error_of({.max_distance_m = 25.4}), "none");
  EXPECT_EQ(error_of({.max_distance_m = 30.0}),
            "distance field: max_distance_m is more than 254 voxels; give at most 25.4 m");
  for (const double bad : {0.05, 0.0, -1.0, not_a_number, HUGE_VAL})
    EXPECT_NE(error_of({.max_distance_m = bad}), "none") << bad;
  for (const double bad : {0.0, -0.1, not_a_number, HUGE_VAL})
    EXPECT_NE(error_of({}, bad), "none") << bad;
  EXPECT_NE(error_of({.occupied = false, .not_free = false}), "none");
  EXPECT_NE(error_of({.size_m = {1, not_a_number, 1}}), "none");
  EXPECT_NE(error_of({.size_m = {1, -2, 1}}), "none");
  EXPECT_NE(error_of({.threads = 0}), "none");
  EXPECT_NE(error_of({.threads = 100000}), "none");
}

}  // namespace
}  // namespace swiftlet
