// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// A distance field makes a sweep quicker and changes nothing else.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "support/hand_made_map.hpp"
#include "support/seeds.hpp"
#include "swiftlet/query/distance/distance_field.hpp"
#include "swiftlet/query/sweep/sweep.hpp"

namespace swiftlet {
namespace {

using test::HandMadeMap;
using Vector = Eigen::Vector3d;

constexpr double kFieldVoxel_m = 0.1;

DistanceField field_of(HandMadeMap& made, const MapSnapshot& map,
                       const DistanceFieldOptions& options = {}) {
  auto field = DistanceField::create(kFieldVoxel_m, made.map().window().size, options).value();
  field.update(map);
  return field;
}

BodyShape any_body(test::Random& random) {
  const double size_m = random.real(0.0, 0.5);
  const int kind = random.integer(0, 2);
  if (kind == 0) return *BodyShape::sphere(size_m, random.vector(-0.2, 0.2));
  if (kind == 1) return *BodyShape::capsule({0, 0, 0}, random.vector(-0.4, 0.4), 0.3 * size_m);
  return *BodyShape::box({size_m, 0.5 * size_m, 0.1},
                         Transform<Body, Body>::trusted(random.rotation(), Vector::Zero()));
}

std::vector<TimedPose> any_path(test::Random& random) {
  std::vector<TimedPose> poses;
  for (int i = random.integer(1, 4); i > 0; --i) {
    const Vector p = random.vector(-2.2, 2.2);
    poses.push_back({{}, Transform<World, Body>::trusted(random.rotation(), p)});
  }
  return poses;
}

TEST(SweepWithField, answers_as_without_whatever_the_body_and_the_path) {
  int clear = 0, stopped = 0;
  test::for_each_seed(40, [&](test::Random& random) {
    HandMadeMap made(kFieldVoxel_m, {4.8, 4.8, 4.8});
    made.fill_window(test::kFree);
    for (int i = random.integer(0, 40); i > 0; --i)
      made.set_at(random.vector(-2.4, 2.4), random.chance(0.5) ? test::kOccupied : kUnknownVoxel);
    const MapSnapshot map = made.snapshot();
    const DistanceField field = field_of(made, map, {.max_distance_m = random.real(0.5, 2.0)});
    for (int i = 0; i < 50; ++i) {
      const BodyShape body = any_body(random);
      const auto poses = any_path(random);
      const auto path = SweepPath::of(poses);
      SweepPolicy policy{
          .unknown = random.chance(0.5) ? UnknownSpace::kStops : UnknownSpace::kPasses,
          .margin_m = random.chance(0.5) ? 0.1 : 0.0};
      const auto plain = sweep(map, body, *path, policy).value();
      policy.field = &field;
      const auto quick = sweep(map, body, *path, policy).value();
      ASSERT_EQ(quick.state, plain.state) << random.repeat();
      ASSERT_NEAR(quick.clear_m, plain.clear_m, 2.0 * kFieldVoxel_m / 16.0) << random.repeat();
      ASSERT_EQ(quick.occupied.has_value(), plain.occupied.has_value()) << random.repeat();
      (plain.state == SweepState::kClear ? clear : stopped) += 1;
    }
  });
  EXPECT_GT(clear, 100);
  EXPECT_GT(stopped, 100);
}

TEST(SweepWithField, refuses_a_field_that_is_not_of_this_map) {
  HandMadeMap made(kFieldVoxel_m, {4.8, 4.8, 4.8});
  made.fill_window(test::kFree);
  const MapSnapshot map = made.snapshot();
  const DistanceField current = field_of(made, map);
  const DistanceField occupied_only = field_of(made, map, {.not_free = false});
  const DistanceField small = field_of(made, map, {.size_m = {1.6, 1.6, 1.6}});
  const MapSnapshot later = made.snapshot();
  const auto body = BodyShape::sphere(0.2);
  const std::array<Vector, 2> points{Vector(-1, 0, 0), Vector(1, 0, 0)};
  const auto path = SweepPath::along(points);
  const auto asked = [&](const MapSnapshot& of, SweepPolicy policy) {
    return sweep(of, *body, *path, policy).has_value();
  };
  EXPECT_TRUE(asked(map, {.field = &current}));
  EXPECT_FALSE(asked(later, {.field = &current}));
  EXPECT_FALSE(asked(map, {.thresholds = {.free_below = 90}, .field = &current}));
  EXPECT_FALSE(asked(map, {.field = &occupied_only}));
  EXPECT_TRUE(asked(map, {.unknown = UnknownSpace::kPasses, .field = &occupied_only}));
  EXPECT_TRUE(asked(map, {.field = &small}));
  EXPECT_FALSE(asked(map, {.unknown = UnknownSpace::kPasses, .field = &small}));
}

}  // namespace
}  // namespace swiftlet
