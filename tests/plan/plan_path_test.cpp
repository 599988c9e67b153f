// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/plan/plan_path.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "plan/plan_support.hpp"

namespace swiftlet {
namespace {

using test::HandMadeMap;
using testing::HasSubstr;
using Vector = Eigen::Vector3d;

/// Two rooms, 6 x 4 x 2 m in all, a wall between them at x = 0 and a door in it, `door_m` wide.
HandMadeMap two_rooms(double door_m) {
  HandMadeMap made(0.1, {6, 4, 2});
  made.fill_window(kUnknownVoxel);
  made.fill({-2.95, -1.95, -0.95}, {2.95, 1.95, 0.95}, test::kFree);
  made.fill({0.01, -1.95, -0.95}, {0.09, 1.95, 0.95}, test::kOccupied);
  if (door_m > 0.0) made.fill({0.01, 1.0, -0.95}, {0.09, 1.0 + door_m - 0.01, 0.95}, test::kFree);
  return made;
}

const Vector kHere(-2.0, -1.0, 0.0), kThere(2.0, -1.0, 0.0);

Error error_of(const MapSnapshot& map, double radius_m, const Vector& from, const Vector& to,
               const PlanOptions& options = {}) {
  const auto path = plan_path(map, *BodyShape::sphere(radius_m), from, to, options);
  EXPECT_FALSE(path);
  return path ? Error{} : path.error();
}

TEST(PlanPath, goes_through_the_door) {
  const auto map = two_rooms(0.9).snapshot();
  const auto path = plan_path(map, *BodyShape::sphere(0.2), kHere, kThere);
  ASSERT_TRUE(path) << path.error().text();
  bool is_through = false;
  for (const Vector& p : path->points)
    is_through |= std::abs(p.x()) < 0.2 && p.y() > 1.0 && p.y() < 1.9;
  EXPECT_TRUE(is_through);
  EXPECT_EQ(path->frame_count, map.frame_count());
}

TEST(PlanPath, keeps_to_the_middle_of_a_door_if_it_may) {
  const auto map = two_rooms(0.9).snapshot();
  const auto close = plan_path(map, *BodyShape::sphere(0.1), kHere, kThere, {.comfort_m = 0.0});
  const auto wide = plan_path(map, *BodyShape::sphere(0.1), kHere, kThere, {.comfort_m = 0.3});
  ASSERT_TRUE(close && wide);
  const auto clearance_m = [&](const PlannedPath& path) {
    return sweep(map, *BodyShape::sphere(0.1), *SweepPath::along(path.points),
                 {.clearance_reach_m = 1.0})
        ->clearance->at_least_m;
  };
  EXPECT_GT(clearance_m(*wide), clearance_m(*close));
  EXPECT_GT(clearance_m(*wide), 0.2);
}

TEST(PlanPath, takes_the_straight_way_where_it_is_clear) {
  const auto map = two_rooms(0.9).snapshot();
  const auto path = plan_path(map, *BodyShape::sphere(0.2), kHere, {-1.0, 1.0, 0.0});
  ASSERT_TRUE(path);
  EXPECT_NEAR(path->length_m, (Vector(-1.0, 1.0, 0.0) - kHere).norm(), 0.05);
}

TEST(PlanPath, to_where_it_is_has_no_length) {
  const auto map = two_rooms(0.9).snapshot();
  const auto path = plan_path(map, *BodyShape::sphere(0.2), kHere, kHere);
  ASSERT_TRUE(path);
  EXPECT_EQ(path->length_m, 0.0);
}

TEST(PlanPath, stays_within_its_bounds) {
  const auto map = two_rooms(0.9).snapshot();
  PlanOptions options;
  options.bounds = SpaceBox{{-3, -2, -0.1}, {3, 2, 0.1}};
  const auto path = plan_path(map, *BodyShape::sphere(0.2), kHere, kThere, options);
  ASSERT_TRUE(path) << path.error().text();
  for (const Vector& p : path->points) EXPECT_LE(std::abs(p.z()), 0.1);
}

TEST(PlanPath, is_not_pushed_out_of_its_bounds_by_comfort) {
  const auto map = two_rooms(0.9).snapshot();
  PlanOptions options;
  options.comfort_m = 0.3;
  options.bounds = SpaceBox{{-3, -2, -0.75}, {3, 2, -0.55}};  // the floor is near
  const Vector down(0, 0, -0.65);
  const auto path = plan_path(map, *BodyShape::sphere(0.2), kHere + down, kThere + down, options);
  ASSERT_TRUE(path) << path.error().text();
  for (const Vector& p : path->points) EXPECT_LE(p.z(), -0.55 + 1e-9);
}

TEST(PlanPath, passes_unknown_space_if_it_is_told_to_even_out_of_the_window) {
  const auto map = two_rooms(0.9).snapshot();
  PlanOptions options;
  options.sweep.unknown = UnknownSpace::kPasses;
  const auto path = plan_path(map, *BodyShape::sphere(0.2), kHere, {9.0, 0.0, 0.0}, options);
  EXPECT_TRUE(path) << path.error().text();
  EXPECT_THAT(error_of(map, 0.2, kHere, {9.0, 0.0, 0.0}).what,
              HasSubstr("outside the window of the map"));
}

TEST(PlanPath, says_that_the_goal_is_in_a_wall) {
  const Error error = error_of(two_rooms(0.9).snapshot(), 0.2, kHere, {0.05, -1.0, 0.0});
  EXPECT_EQ(error.code, ErrorCode::kUsage);
  EXPECT_EQ(error.where, "to");
  EXPECT_THAT(error.what, HasSubstr("0.05,-1.00,0.00 is inside an obstacle"));
}

TEST(PlanPath, says_what_the_start_would_touch) {
  const Error error = error_of(two_rooms(0.9).snapshot(), 0.2, {-0.15, 0.0, 0.0}, kThere);
  EXPECT_EQ(error.where, "from");
  EXPECT_THAT(error.what, HasSubstr("would touch the occupied voxel at 0.05,"));
  EXPECT_EQ(error_of(two_rooms(0.9).snapshot(), 0.2, {0.05, 0.0, 0.0}, kThere).where, "from");
}

TEST(PlanPath, says_that_a_place_was_never_seen) {
  auto made = two_rooms(0.9);
  made.fill({1.5, -1.5, -0.5}, {2.5, -0.5, 0.5}, kUnknownVoxel);
  EXPECT_THAT(error_of(made.snapshot(), 0.2, kHere, kThere).what, HasSubstr("was never seen"));
}

TEST(PlanPath, says_that_the_body_is_larger_than_the_room) {
  const Error error = error_of(two_rooms(0.9).snapshot(), 1.5, kHere, kThere);
  EXPECT_EQ(error.where, "from");
  EXPECT_THAT(error.what, HasSubstr("the body, 1.50 m from its middle to its rim, would touch"));
  EXPECT_THAT(error_of(two_rooms(0.9).snapshot(), 100.0, kHere, kThere).what,
              HasSubstr("farther than the window"));
}

TEST(PlanPath, says_that_there_is_no_way_at_all) {
  const Error error = error_of(two_rooms(0.0).snapshot(), 0.2, kHere, kThere);
  EXPECT_EQ(error.code, ErrorCode::kNotFound);
  EXPECT_THAT(error.what, HasSubstr("there is no way from"));
}

TEST(PlanPath, says_that_none_was_found_where_the_door_is_too_narrow) {
  const Error error = error_of(two_rooms(0.3).snapshot(), 0.3, kHere, kThere);
  EXPECT_EQ(error.code, ErrorCode::kNotFound);
  EXPECT_THAT(error.what, HasSubstr("was found in 20000 iterations"));
}

TEST(PlanPath, refuses_numbers_that_are_none) {
  const auto map = two_rooms(0.9).snapshot();
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of(map, 0.2, {kNan, 0, 0}, kThere).where, "from");
  EXPECT_EQ(error_of(map, 0.2, kHere, {0, 0, std::numeric_limits<double>::infinity()}).where, "to");
  EXPECT_EQ(error_of(map, 0.2, kHere, kThere, {.comfort_m = kNan}).code, ErrorCode::kUsage);
  EXPECT_EQ(error_of(map, 0.2, kHere, kThere, {.max_iterations = 0}).code, ErrorCode::kUsage);
  PlanOptions options;
  options.bounds = SpaceBox{{1, 1, 1}, {-1, -1, -1}};
  EXPECT_EQ(error_of(map, 0.2, kHere, kThere, options).where, "bounds");
  options.bounds.reset();
  options.sweep.margin_m = kNan;
  EXPECT_EQ(error_of(map, 0.2, kHere, kThere, options).code, ErrorCode::kUsage);
}

TEST(PlanPath, refuses_a_field_of_another_frame) {
  auto made = two_rooms(0.9);
  const auto field = test::field_of(made.snapshot());
  const auto path = plan_path(made.snapshot(), field, *BodyShape::sphere(0.2), kHere, kThere);
  ASSERT_FALSE(path);
  EXPECT_THAT(path.error().what, HasSubstr("the field is of frame 1, the map of frame 2"));
}

}  // namespace
}  // namespace swiftlet
