// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/distance_field.hpp"

#include <gtest/gtest.h>

#include "support/allocations.hpp"
#include "support/brute_distance.hpp"
#include "support/every_instruction_set.hpp"
#include "support/seeds.hpp"
#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet {
namespace {

using test::BruteDistance;
using test::kBothObstacles;
using test::Random;
using test::same_bits;

constexpr double kCell_m = 0.25;

/// A map that changes at random: cells, whole blocks, and where its window is.
class RestlessMap {
 public:
  RestlessMap(Random& random, const Eigen::Vector3d& size_m) : random_(random) {
    map_ = *RollingMap::create(
        {.voxel_m = kCell_m, .size_m = size_m, .trigger_m = {0.01, 0.01, 0.01}});
    map_->recentre(vehicle_, nullptr);
    for_each_block(map_->window(), [&](const BlockIndex& b) {
      if (random_.chance(0.6)) fill(b, 0.02);
    });
  }
  RollingMap& map() { return *map_; }

  MapSnapshot changed() {
    if (random_.chance(0.4)) move();
    const int edits = random_.integer(0, 4);
    for (int i = 0; i < edits; ++i) {
      const BlockIndex b = any_block();
      const double kind = random_.real(0, 1);
      if (kind < 0.2) {
        fill(b, random_.real(0, 0.1));
      } else if (kind < 0.3) {
        map_->writable(b).clear();
      } else {
        for (int n = random_.integer(1, 20); n > 0; --n)
          map_->writable(b).cells[random_.integer<std::size_t>(0, kBlockVoxels - 1)] =
              any_cell(0.4);
      }
    }
    return *map_->snapshot(++frames_);
  }

 private:
  void move() {
    const double farthest_m = random_.chance(0.1) ? 40.0 : random_.chance(0.3) ? 6.0 : 2.5;
    vehicle_ += random_.vector(-farthest_m, farthest_m);
    const BlockWindow before = map_->window();
    map_->recentre(vehicle_, nullptr);
    for_each_block_outside(map_->window(), before, [&](const BlockIndex& b) {
      if (random_.chance(0.5)) fill(b, 0.02);
    });
  }
  LogOdds any_cell(double occupied) {
    return random_.chance(occupied) ? 220 : random_.chance(0.1) ? kUnknownCell : 20;
  }
  void fill(const BlockIndex& b, double occupied) {
    for (LogOdds& cell : map_->writable(b).cells) cell = any_cell(occupied);
  }
  BlockIndex any_block() {
    const BlockWindow& w = map_->window();
    return {w.first.x + random_.integer(0, w.size.x - 1),
            w.first.y + random_.integer(0, w.size.y - 1),
            w.first.z + random_.integer(0, w.size.z - 1)};
  }

  Random& random_;
  std::optional<RollingMap> map_;
  Eigen::Vector3d vehicle_{0.3, -0.2, 0.1};
  std::uint64_t frames_ = 0;
};

VoxelIndex any_voxel(Random& random, const BlockWindow& box) {
  const VoxelBox v = voxel_box(box);
  return {random.integer(v.first.x, v.last.x), random.integer(v.first.y, v.last.y),
          random.integer(v.first.z, v.last.z)};
}

DistanceField field_for(const RollingMap& map, const DistanceFieldOptions& options) {
  auto field = DistanceField::create(map.voxel_m(), map.window().size, options);
  EXPECT_TRUE(field) << field.error().text();
  return std::move(*field);
}

/// What a field must say of a voxel.
void expect_true_distance(const DistanceField& field, const BruteDistance& truth,
                          const VoxelIndex& v, Obstacles obstacles) {
  const DistanceFieldOptions& options = field.options();
  const auto squared = truth.squared(v, obstacles);
  ASSERT_EQ(field.squared_voxels(v, obstacles), squared);
  double distance_m = squared ? std::sqrt(*squared) * kCell_m : options.max_distance_m;
  if (options.is_signed && truth.is_obstacle(v, obstacles)) {
    const auto inside = truth.squared(v, obstacles, true);
    distance_m = kCell_m - (inside ? std::sqrt(*inside) * kCell_m : options.max_distance_m);
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
  options.max_distance_m = kCell_m * random.real(1.0, 9.0);
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
    BruteDistance truth(options.max_distance_m / kCell_m);
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
    auto map = RollingMap::create({.voxel_m = kCell_m, .size_m = {4, 4, 4}});
    map->recentre(Eigen::Vector3d::Zero(), nullptr);
    for_each_block(map->window(), [&](const BlockIndex& b) { map->writable(b).cells.fill(20); });
    map->writable(block_of(obstacle)).cells[offset_in_block(obstacle)] = 220;
    return std::move(*map);
  };
  RollingMap first = map_with({1, 1, 1}), second = map_with({-3, 2, 0});
  DistanceField field = field_for(first, {});
  field.update(*first.snapshot(1));
  field.update(*second.snapshot(1));
  EXPECT_EQ(field.squared_voxels({-3, 2, 0}, Obstacles::kOccupied), 0);
  EXPECT_NE(field.squared_voxels({1, 1, 1}, Obstacles::kOccupied), 0);
}

TEST(DistanceField, knows_a_wall_and_a_ball_within_the_diagonal_of_a_voxel) {
  auto map = RollingMap::create({.voxel_m = 0.1, .size_m = {6, 6, 6}});
  map->recentre(Eigen::Vector3d::Zero(), nullptr);
  const double wall_x_m = 2.0, radius_m = 0.8;
  for_each_block(map->window(), [&](const BlockIndex& b) {
    for (int i = 0; i < kBlockVoxels; ++i) {
      const Eigen::Vector3d p = centre_of(voxel_at(b, i), 0.1);
      map->writable(b).cells[i] = p.x() > wall_x_m || p.norm() < radius_m ? 220 : 20;
    }
  });
  DistanceField field = field_for(*map, {.max_distance_m = 1.5, .is_signed = true});
  field.update(*map->snapshot(1));
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
      const DistanceSample here = field.sample(p * kCell_m, obstacles);
      Eigen::Vector3d slope;
      for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Vector3d step = Eigen::Vector3d::Unit(axis) * 1e-4 * kCell_m;
        slope[axis] = (field.sample(p * kCell_m + step, obstacles).distance_m -
                       field.sample(p * kCell_m - step, obstacles).distance_m) /
                      (2e-4 * kCell_m);
      }
      // Trilinear is linear along each axis, so all that is left is rounding: 1e-16 / 1e-5.
      ASSERT_LT((slope - here.gradient).norm(), 1e-8);
      // No steps: a Lipschitz constant of sqrt(3), also across the seams between eight centres.
      const Eigen::Vector3d q = p + random.vector(-0.01, 0.01);
      const DistanceSample there = field.sample(q * kCell_m, obstacles);
      ASSERT_LE(std::abs(there.distance_m - here.distance_m),
                std::sqrt(3.0) * (q - p).norm() * kCell_m + 1e-9);
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
        const double claimed_m = field.sample(p * kCell_m, obstacles).distance_m - margin_m;
        ASSERT_LE(claimed_m, true_voxels * kCell_m + 1e-6);
        ASSERT_LE(field.distance(v, obstacles).distance_m - margin_m, true_voxels * kCell_m + 1e-6);
        tight += claimed_m > 0.5 * true_voxels * kCell_m ? 1 : 0;
      }
    }
  }
  EXPECT_GT(tight, 10);
}

TEST(DistanceField, says_what_an_answer_is_worth) {
  auto map = RollingMap::create({.voxel_m = kCell_m, .size_m = {6, 6, 6}});
  map->recentre(Eigen::Vector3d::Zero(), nullptr);
  for (const BlockIndex b : {BlockIndex{0, 0, 0}, BlockIndex{-1, 0, 0}}) {
    map->writable(b).cells.fill(20);
  }
  map->writable({0, 0, 0}).cells[offset_in_block({7, 4, 4})] = 220;
  DistanceField field = field_for(*map, {.max_distance_m = 1.0});
  constexpr auto kOccupied = Obstacles::kOccupied, kNotFree = Obstacles::kNotFree;
  EXPECT_EQ(field.distance({0, 0, 0}, kOccupied).status, DistanceStatus::kOutside) << "no map yet";
  field.update(*map->snapshot(1));
  EXPECT_EQ(field.distance({5, 4, 4}, kOccupied).status, DistanceStatus::kKnown);
  EXPECT_EQ(field.distance({5, 4, 4}, kOccupied).distance_m, 2 * kCell_m);
  EXPECT_EQ(field.distance({-2, 4, 4}, kOccupied).status, DistanceStatus::kBeyondReach);
  EXPECT_EQ(field.distance({-2, 4, 4}, kOccupied).distance_m, 1.0);
  EXPECT_EQ(field.distance({8, 4, 4}, kOccupied).status, DistanceStatus::kUnknownHere);
  EXPECT_EQ(field.distance({8, 4, 4}, kOccupied).distance_m, kCell_m);
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
            "distance field: max_distance_m is more than 254 cells; give at most 25.4 m");
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
