// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// A distance field is that of the map it follows, however that changes.

#include "swiftlet/query/distance/distance_field.hpp"

#include <gtest/gtest.h>

#include "query/restless_map.hpp"
#include "support/allocations.hpp"
#include "support/brute_distance.hpp"
#include "support/every_instruction_set.hpp"

namespace swiftlet {
namespace {

using test::any_voxel;
using test::BruteDistance;
using test::field_for;
using test::kBothObstacles;
using test::kRestlessVoxel_m;
using test::Random;
using test::RestlessMap;
using test::same_bits;

/// What a field must say of a voxel.
void expect_true_distance(const DistanceField& field, const BruteDistance& truth,
                          const VoxelIndex& v, Obstacles obstacles) {
  const DistanceFieldOptions& options = field.options();
  const auto squared = truth.squared(v, obstacles);
  ASSERT_EQ(field.squared_voxels(v, obstacles), squared);
  double distance_m = squared ? std::sqrt(*squared) * kRestlessVoxel_m : options.max_distance_m;
  if (options.is_signed && truth.is_obstacle(v, obstacles)) {
    const auto inside = truth.squared(v, obstacles, true);
    distance_m = kRestlessVoxel_m -
                 (inside ? std::sqrt(*inside) * kRestlessVoxel_m : options.max_distance_m);
  }
  const DistanceAnswer answer = field.distance(v, obstacles);
  ASSERT_NEAR(answer.distance_m, distance_m, 1e-6);  // kept as float
  const DistanceStatus status = truth.class_of(v) == Occupancy::kUnknown
                                    ? DistanceStatus::kUnknownHere
                                : squared ? DistanceStatus::kKnown
                                          : DistanceStatus::kBeyondReach;
  ASSERT_EQ(answer.status, status);
  const auto nearest = field.closest_obstacle(v, obstacles);
  ASSERT_EQ(nearest.has_value(), squared.has_value());
  if (!nearest) return;
  ASSERT_TRUE(truth.is_obstacle(*nearest, obstacles));
  const int x = nearest->x - v.x, y = nearest->y - v.y, z = nearest->z - v.z;
  ASSERT_EQ(x * x + y * y + z * z, *squared);
}

DistanceFieldOptions any_options(Random& random) {
  DistanceFieldOptions options;
  options.max_distance_m = kRestlessVoxel_m * random.real(1.0, 9.0);
  options.is_signed = random.chance(0.5);
  options.occupied = random.chance(0.8);
  options.not_free = !options.occupied || random.chance(0.8);
  options.threads = random.integer(1, 3);
  if (random.chance(0.4)) options.size_m = random.vector(0.0, 8.0);
  return options;
}

// The law of the whole thing: edits, moves of the window in any direction and over any distance,
// odd and even windows, smaller boxes, both kinds, both signs, any number of threads.
TEST(DistanceField, equals_one_from_scratch_and_the_truth_after_every_update) {
  test::for_each_seed(24, [](Random& random) {
    RestlessMap world(random, {random.real(2, 8), random.real(2, 5), random.real(2, 4)});
    const DistanceFieldOptions options = any_options(random);
    DistanceField field = field_for(world.map(), options);
    BruteDistance truth(options.max_distance_m / kRestlessVoxel_m);
    for (int i = 0; i < 20; ++i) {
      const MapSnapshot map = world.changed();
      if (random.chance(0.2)) continue;  // a field need not see every frame
      field.update(map);
      ASSERT_EQ(field.frame_count(), map.frame_count());
      DistanceField fresh = field_for(world.map(), options);
      fresh.update(map);
      ASSERT_TRUE(same_bits(field, fresh)) << "after update " << i;
      truth.look(map, field.box(), options.thresholds);
      for (int n = 0; n < 100; ++n) {
        const VoxelIndex v = any_voxel(random, field.box());
        for (const Obstacles obstacles : kBothObstacles) {
          const bool is_asked =
              obstacles == Obstacles::kOccupied ? options.occupied : options.not_free;
          if (!is_asked) continue;
          ASSERT_NO_FATAL_FAILURE(expect_true_distance(field, truth, v, obstacles));
        }
      }
    }
  });
}

TEST(DistanceField, follows_a_place_with_a_box_smaller_than_the_window) {
  Random random;
  RestlessMap world(random, {9, 9, 5});
  DistanceFieldOptions options{.max_distance_m = 1.0, .size_m = {4, 3.9, 2.1}};
  DistanceField field = field_for(world.map(), options);
  EXPECT_EQ(field.box().size, (BlockIndex{2, 2, 2}));
  BruteDistance truth(4.0);
  Eigen::Vector3d place{0, 0, 0};
  int moves = 0;
  for (int i = 0; i < 60; ++i) {
    place += random.vector(-0.8, 0.8);
    const MapSnapshot map = world.changed();
    const BlockWindow before = field.box();
    field.update(map, place);
    moves += before == field.box() ? 0 : 1;
    truth.look(map, field.box(), options.thresholds);
    for (int n = 0; n < 50; ++n) {
      const VoxelIndex v = any_voxel(random, field.box());
      for (const Obstacles obstacles : kBothObstacles)
        ASSERT_NO_FATAL_FAILURE(expect_true_distance(field, truth, v, obstacles));
      ASSERT_TRUE(map.window().contains(block_of(v)));
    }
  }
  EXPECT_GT(moves, 10);
}

// Versions count from one in every map, so those of two maps are alike.
TEST(DistanceField, does_not_take_one_map_for_another_whose_versions_are_alike) {
  const auto map_with = [](const VoxelIndex& obstacle) {
    auto map = RollingMap::create({.voxel_m = kRestlessVoxel_m, .size_m = {4, 4, 4}});
    map->recentre(Eigen::Vector3d::Zero(), nullptr);
    for_each_block(map->window(), [&](const BlockIndex& b) { map->writable(b).voxels.fill(20); });
    map->writable(block_of(obstacle)).voxels[offset_in_block(obstacle)] = 220;
    return std::move(*map);
  };
  RollingMap first = map_with({1, 1, 1}), second = map_with({-3, 2, 0});
  DistanceField field = field_for(first, {});
  field.update(*first.snapshot({1}));
  field.update(*second.snapshot({1}));
  EXPECT_EQ(field.squared_voxels({-3, 2, 0}, Obstacles::kOccupied), 0);
  EXPECT_NE(field.squared_voxels({1, 1, 1}, Obstacles::kOccupied), 0);
}

TEST(DistanceField, allocates_nothing_when_it_follows_a_map) {
  Random random;
  RestlessMap world(random, {9, 8, 5});
  DistanceField field = field_for(world.map(), {.is_signed = true, .threads = 2});
  for (int i = 0; i < 30; ++i) {
    const MapSnapshot map = world.changed();
    const test::AllocationCount allocations;
    field.update(map);
    ASSERT_EQ(allocations.so_far(), 0U);
  }
}

TEST(DistanceField, has_the_same_bits_on_every_instruction_set_of_this_machine) {
  const auto flown = [] {
    Random random(7);
    RestlessMap world(random, {9, 6, 5});
    DistanceField field = field_for(world.map(), {.max_distance_m = 1.7, .is_signed = true});
    for (int i = 0; i < 20; ++i) field.update(world.changed());
    return field;
  };
  const DistanceField widest = flown();
  const int targets = test::on_every_instruction_set(
      [&](const char* name) { EXPECT_TRUE(same_bits(flown(), widest)) << name; });
  EXPECT_GE(targets, 1);
}

}  // namespace
}  // namespace swiftlet
