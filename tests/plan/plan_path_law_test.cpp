// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Paths through random clutter, judged by trying every voxel near them.

#include <gtest/gtest.h>

#include <numbers>

#include "plan/plan_support.hpp"
#include "swiftlet/plan/plan_path.hpp"
#include "swiftlet/plan/reachable_space.hpp"

namespace swiftlet {
namespace {

using test::Clutter;
using test::Random;

PlanOptions random_plan_options(Random& random) {
  PlanOptions options;
  options.sweep.margin_m = random.chance(0.5) ? 0.0 : random.real(0.0, 0.05);
  options.sweep.unknown = random.chance(0.7) ? UnknownSpace::kStops : UnknownSpace::kPasses;
  options.comfort_m = random.real(0.0, 0.4);
  options.search = random.chance(0.7) ? PathSearch::kFirst : PathSearch::kBest;
  options.max_iterations = options.search == PathSearch::kFirst ? 5000 : 1000;
  options.seed = random.integer<std::uint64_t>(1, 1000);
  return options;
}

/// Steps of a millimetre or two: what a ball cannot pass, it cannot step over.
void expect_clear_by_hand(const MapSnapshot& map, const PlannedPath& path, double radius_m,
                          UnknownSpace unknown) {
  for (std::size_t i = 1; i < path.points.size(); ++i) {
    const Eigen::Vector3d leg = path.points[i] - path.points[i - 1];
    const int steps = std::max(1, static_cast<int>(leg.norm() / 0.002));
    for (int k = 0; k <= steps; ++k) {
      const Eigen::Vector3d p = path.points[i - 1] + leg * k / steps;
      ASSERT_FALSE(test::touches_by_hand(map, p, radius_m, unknown)) << p.transpose();
    }
  }
}

TEST(PlannedPaths, touch_nothing_that_stops_them) {
  int found = 0, asked = 0;
  test::for_each_seed(40, [&](Random& random) {
    Clutter clutter(random);
    const auto map = clutter.made().snapshot();
    const double radius_m = random.real(0.05, 0.25);
    const auto body = *BodyShape::sphere(radius_m);
    const PlanOptions options = random_plan_options(random);
    const auto path = plan_path(map, body, Clutter::kFrom, Clutter::kTo, options);
    ++asked;
    if (!path) {
      EXPECT_EQ(path.error().code, ErrorCode::kNotFound) << path.error().text();
      return;
    }
    ++found;
    EXPECT_EQ(path->points.front(), Clutter::kFrom);
    EXPECT_EQ(path->points.back(), Clutter::kTo);
    EXPECT_NEAR(path->length_m, length_of(path->points), 1e-9);
    expect_clear_by_hand(map, *path, radius_m + options.sweep.margin_m, options.sweep.unknown);
    const auto swept = sweep(map, body, *SweepPath::along(path->points), options.sweep);
    EXPECT_EQ(swept->state, SweepState::kClear);
  });
  EXPECT_GT(found, asked / 2);
}

TEST(PlannedPaths, are_found_wherever_a_flood_finds_room) {
  test::for_each_seed(25, [](Random& random) {
    Clutter clutter(random);
    const auto map = clutter.made().snapshot();
    const auto body = *BodyShape::sphere(0.15);
    const auto field = test::field_of(map);
    ReachableSpace space;
    // Half a voxel's diagonal for where a ball is within it, one for what fills its own.
    space.flood(field, Obstacles::kNotFree, Clutter::kFrom, 0.15 + std::numbers::sqrt3 * 0.1);
    if (!space.path_m(Clutter::kTo)) return;
    const auto path = plan_path(map, field, body, Clutter::kFrom, Clutter::kTo);
    ASSERT_TRUE(path) << path.error().text();
    EXPECT_LT(path->length_m, 1.2 * *space.path_m(Clutter::kTo) + 0.5);
  });
}

TEST(PlannedPaths, are_the_same_for_the_same_seed_whatever_was_planned_between) {
  test::for_each_seed(10, [](Random& random) {
    Clutter clutter(random);
    const auto map = clutter.made().snapshot();
    const auto body = *BodyShape::sphere(0.1);
    const PlanOptions options = random_plan_options(random);
    const auto first = plan_path(map, body, Clutter::kFrom, Clutter::kTo, options);
    PlanOptions other = options;
    other.seed += 17;
    const auto between = plan_path(map, body, Clutter::kTo, Clutter::kFrom, other);
    const auto again = plan_path(map, body, Clutter::kFrom, Clutter::kTo, options);
    ASSERT_EQ(first.has_value(), again.has_value());
    EXPECT_EQ(first.has_value(), between.has_value());
    EXPECT_TRUE(!first || first->points == again->points);
  });
}

}  // namespace
}  // namespace swiftlet
