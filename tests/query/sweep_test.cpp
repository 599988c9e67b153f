// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/hand_made_map.hpp"

namespace swiftlet {
namespace {

using test::HandMadeMap;
using Points = std::vector<Eigen::Vector3d>;

constexpr double kSweepVoxel_m = 0.1;
constexpr double kFine_m = kSweepVoxel_m / 16.0;  // to which contacts are told

SweepAnswer swept(const MapSnapshot& map, const BodyShape& body, const Points& points,
                  const SweepPolicy& policy = {}) {
  const auto path = SweepPath::along(points);
  EXPECT_TRUE(path);
  const auto answer = sweep(map, body, *path, policy);
  EXPECT_TRUE(answer) << answer.error().text();
  return answer.value_or(SweepAnswer{});
}

Transform<World, Body> turned(double yaw_rad, const Eigen::Vector3d& p = {0, 0, 0}) {
  return Transform<World, Body>::trusted(
      Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), p);
}

TEST(Sweep, is_clear_where_all_voxels_are_free_and_stops_before_a_wall) {
  HandMadeMap world(kSweepVoxel_m, {8, 8, 3});
  world.fill({-3.95, -3.95, -1.45}, {3.95, 3.95, 1.45}, test::kFree);
  world.fill({3.0, -3.95, -1.45}, {3.09, 3.95, 1.45}, test::kOccupied);
  const auto map = world.snapshot();
  const auto body = BodyShape::sphere(0.4);
  const SweepAnswer clear = swept(map, *body, {{-2, 0, 0}, {2, 0, 0}, {2, 2, 0}});
  EXPECT_EQ(clear.state, SweepState::kClear);
  EXPECT_FALSE(clear.occupied || clear.unknown);
  EXPECT_DOUBLE_EQ(clear.length_m, 6.0);
  EXPECT_DOUBLE_EQ(clear.clear_m, 6.0);

  const SweepAnswer blocked = swept(map, *body, {{-2, 0, 0}, {3.2, 0, 0}});
  EXPECT_EQ(blocked.state, SweepState::kBlocked);
  ASSERT_TRUE(blocked.occupied);
  EXPECT_EQ(blocked.occupied->voxel.x, 30);
  EXPECT_NEAR(blocked.occupied->path_m, 3.0 - 0.4 + 2.0, 2 * kFine_m);
  EXPECT_LE(blocked.clear_m, 3.0 - 0.4 + 2.0);
  const SweepAnswer with_margin = swept(map, *body, {{-2, 0, 0}, {3.2, 0, 0}}, {.margin_m = 0.2});
  EXPECT_NEAR(with_margin.clear_m, 4.4, 2 * kFine_m);
}

TEST(Sweep, tells_unknown_space_from_matter_and_both_from_each_other) {
  HandMadeMap world(kSweepVoxel_m, {8, 8, 3});
  world.fill({-3.95, -1, -1}, {3.95, 1, 1}, test::kFree);
  world.fill({1.0, -1, -1}, {1.09, 1, 1}, kUnknownVoxel);
  world.fill({2.0, -1, -1}, {2.09, 1, 1}, test::kOccupied);
  const auto map = world.snapshot();
  const auto body = BodyShape::sphere(0.3);
  const SweepAnswer unknown = swept(map, *body, {{0, 0, 0}, {1, 0, 0}});
  EXPECT_EQ(unknown.state, SweepState::kUnknown);
  EXPECT_NEAR(unknown.clear_m, 0.7, 2 * kFine_m);
  const SweepAnswer both = swept(map, *body, {{0, 0, 0}, {3, 0, 0}});
  EXPECT_EQ(both.state, SweepState::kBlocked);
  EXPECT_NEAR(both.unknown->path_m, 0.7, 2 * kFine_m);
  EXPECT_NEAR(both.occupied->path_m, 1.7, 2 * kFine_m);
  EXPECT_DOUBLE_EQ(both.clear_m, both.unknown->path_m);
  const SweepPolicy brave{.unknown = UnknownSpace::kPasses};
  EXPECT_EQ(swept(map, *body, {{0, 0, 0}, {1, 0, 0}}, brave).state, SweepState::kClear);
  EXPECT_NEAR(swept(map, *body, {{0, 0, 0}, {3, 0, 0}}, brave).clear_m, 1.7, 2 * kFine_m);
}

TEST(Sweep, calls_what_lies_outside_the_window_unknown) {
  HandMadeMap world(kSweepVoxel_m, {4, 4, 2});
  world.fill_window(test::kFree);
  const auto map = world.snapshot();
  const double rim_m = map.window().end().x * kBlockEdge * kSweepVoxel_m;
  const auto body = BodyShape::sphere(0.3);
  const SweepAnswer out = swept(map, *body, {{0, 0, 0}, {50, 0, 0}});
  EXPECT_EQ(out.state, SweepState::kUnknown);
  EXPECT_NEAR(out.clear_m, rim_m - 0.3, 2 * kFine_m);
  EXPECT_GE(out.unknown->voxel.x, 8 * map.window().end().x);
  const SweepAnswer through = swept(map, *body, {{-900000, 1, 0}, {900000, 0, 0}});
  EXPECT_EQ(through.state, SweepState::kUnknown);
  EXPECT_EQ(through.clear_m, 0.0);
  EXPECT_EQ(swept(map, *body, {{-900000, 1, 0}, {900000, 0, 0}}, {.unknown = UnknownSpace::kPasses})
                .state,
            SweepState::kClear);
}

TEST(Sweep, sees_what_a_turning_body_touches_between_two_poses_that_are_clear) {
  HandMadeMap world(kSweepVoxel_m, {6, 6, 2});
  world.fill_window(test::kFree);
  world.fill({-2.9, 0.75, -0.9}, {2.9, 0.75, 0.9}, test::kOccupied);  // from y = 0.7 on
  const auto map = world.snapshot();
  const auto plank = BodyShape::box({2.0, 0.1, 0.1});
  const std::array<TimedPose, 2> turn{TimedPose{{1'000'000'000}, turned(0.0)},
                                      TimedPose{{3'000'000'000}, turned(0.999 * std::numbers::pi)}};
  for (const TimedPose& pose : turn) {
    EXPECT_EQ(sweep(map, *plank, *SweepPath::of({&pose, 1}))->state, SweepState::kClear);
  }
  const auto answer = sweep(map, *plank, *SweepPath::of(turn));
  ASSERT_EQ(answer->state, SweepState::kBlocked);
  // The farther corner is where y = 0.7 is reached first.
  const double corner_m = std::hypot(1.0, 0.05);
  const double angle_rad = std::asin(0.7 / corner_m) - std::atan2(0.05, 1.0);
  const double share = angle_rad / (0.999 * std::numbers::pi);
  EXPECT_NEAR(answer->occupied->leg_share, share, 0.01);
  EXPECT_LE(answer->occupied->leg_share, share);
  EXPECT_NEAR(seconds(answer->occupied->stamp - Stamp{1'000'000'000}), 2.0 * share, 0.02);
  EXPECT_EQ(answer->length_m, 0.0);
}

TEST(Sweep, tells_the_least_clearance_and_where_it_is) {
  HandMadeMap world(kSweepVoxel_m, {8, 8, 3});
  world.fill_window(test::kFree);
  world.set_at({1.05, 0.75, 0.05}, test::kOccupied);
  const auto map = world.snapshot();
  const auto body = BodyShape::sphere(0.3);
  const SweepPolicy policy{.clearance_reach_m = 1.0};
  const SweepAnswer passing = swept(map, *body, {{-2, 0.05, 0.05}, {2, 0.05, 0.05}}, policy);
  EXPECT_EQ(passing.state, SweepState::kClear);
  ASSERT_TRUE(passing.clearance && passing.clearance->voxel);
  EXPECT_LE(passing.clearance->at_least_m, 0.35);
  EXPECT_NEAR(passing.clearance->at_least_m, 0.35, 0.02 * kSweepVoxel_m);
  EXPECT_EQ(*passing.clearance->voxel, voxel_containing({1.05, 0.75, 0.05}, kSweepVoxel_m));
  EXPECT_NEAR(passing.clearance->path_m, 3.05, 0.06);

  const SweepAnswer far =
      swept(map, *body, {{-2, -1, 0}, {-2, -1, 0.1}}, {.clearance_reach_m = 0.4});
  EXPECT_EQ(far.clearance->at_least_m, 0.4);
  EXPECT_FALSE(far.clearance->voxel);
  const SweepAnswer hit = swept(map, *body, {{0, 0.75, 0.05}, {2, 0.75, 0.05}}, policy);
  EXPECT_EQ(hit.clearance->at_least_m, 0.0);
  EXPECT_EQ(swept(map, *body, {{-2, 0, 0}, {2, 0, 0}}).clearance, std::nullopt);
}

TEST(Sweep, takes_a_union_for_all_its_parts) {
  HandMadeMap world(kSweepVoxel_m, {6, 6, 2});
  world.fill_window(test::kFree);
  world.set_at({1.05, 0.95, 0.05}, test::kOccupied);
  const auto map = world.snapshot();
  const std::vector<BodyShape> parts{*BodyShape::sphere(0.2),
                                     *BodyShape::capsule({0, 0, 0}, {0, 0.8, 0}, 0.1)};
  const Points path{{-1, 0.05, 0.05}, {2, 0.05, 0.05}};
  EXPECT_EQ(swept(map, parts[0], path).state, SweepState::kClear);
  EXPECT_EQ(swept(map, parts[1], path).state, SweepState::kBlocked);
  EXPECT_EQ(swept(map, *BodyShape::united(parts), path).state, SweepState::kBlocked);
}

TEST(Sweep, answers_or_refuses_with_what_to_do_whatever_it_is_given) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInf = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(BodyShape::sphere(-0.1));
  EXPECT_FALSE(BodyShape::sphere(kNan));
  EXPECT_FALSE(BodyShape::capsule({0, 0, 0}, {kInf, 0, 0}, 0.1));
  EXPECT_FALSE(BodyShape::box({1, -1, 1}));
  EXPECT_FALSE(BodyShape::united({}));
  EXPECT_FALSE(SweepPath::along({}));
  for (const double bad : {kNan, kInf, -kInf, 1e7}) {
    const Points points{{0, 0, 0}, {0, bad, 0}};
    const auto path = SweepPath::along(points);
    ASSERT_FALSE(path);
    EXPECT_EQ(path.error().where, "path");
    EXPECT_FALSE(path.error().remedy.empty());
  }
  const std::array<TimedPose, 2> back{TimedPose{{2}, turned(0)}, TimedPose{{1}, turned(0)}};
  EXPECT_EQ(SweepPath::of(back).error().text(),
            "path: time goes back at pose 1, from 2 ns to 1 ns; sort the poses by time");

  HandMadeMap world(kSweepVoxel_m, {2, 2, 1});
  world.fill_window(test::kFree);
  const auto map = world.snapshot();
  const Points here{{0, 0, 0}};
  EXPECT_EQ(swept(map, *BodyShape::sphere(0.2), here).state, SweepState::kClear);
  EXPECT_EQ(swept(map, *BodyShape::sphere(2.0), here).state, SweepState::kUnknown);
  EXPECT_EQ(sweep(map, *BodyShape::sphere(200.0), *SweepPath::along(here)).error().where, "sweep");
  for (const double bad : {kNan, -1.0, 1e3}) {
    EXPECT_FALSE(sweep(map, *BodyShape::sphere(0.1), *SweepPath::along(here), {.margin_m = bad}));
    EXPECT_FALSE(
        sweep(map, *BodyShape::sphere(0.1), *SweepPath::along(here), {.clearance_reach_m = bad}));
  }
}

TEST(FreeDistance, ends_where_the_body_would_touch_something) {
  HandMadeMap world(kSweepVoxel_m, {8, 8, 3});
  world.fill_window(test::kFree);
  world.fill({3.0, -3, -1}, {3.09, 3, 1}, test::kOccupied);
  const auto map = world.snapshot();
  const auto body = BodyShape::capsule({-0.2, 0, 0}, {0.2, 0, 0}, 0.1);
  const auto free_m = [&](const Eigen::Vector3d& course, double yaw_rad) {
    return free_distance_along(map, *body, turned(yaw_rad), course, 10.0).value_or(-1.0);
  };
  EXPECT_NEAR(free_m({2, 0, 0}, 0.0), 2.7, 2 * kFine_m);
  EXPECT_NEAR(free_m({2, 0, 0}, std::numbers::pi / 2), 2.9, 2 * kFine_m);
  EXPECT_EQ(free_m({0, 0, 0}, 0.0), -1.0);
  EXPECT_EQ(free_m({std::nan(""), 0, 0}, 0.0), -1.0);
  EXPECT_FALSE(free_distance_along(map, *body, turned(0), {1, 0, 0}, -2.0));
}

}  // namespace
}  // namespace swiftlet
