// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Whole flights through a small room with a wall across it, which leaves a gap at one end.

#include "swiftlet/fly/fly.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "swiftlet/fly/flight_task.hpp"

namespace swiftlet {
namespace {

using Vector = Eigen::Vector3d;

sim::Object wall(const Vector& from, const Vector& to) {
  return {"wall", sim::Box{0.5 * (from + to), to - from}, 0};
}

/// 7 x 5 x 2.4 m inside; the wall stands at x = 3.4 m, the gap is at y from 3.6 m on.
sim::Scene divided_room() {
  sim::Scene scene;
  scene.name = "divided room";
  scene.objects = {
      wall({-0.2, -0.2, -0.2}, {7.2, 5.2, 0.0}), wall({-0.2, -0.2, 2.4}, {7.2, 5.2, 2.6}),
      wall({-0.2, -0.2, 0.0}, {0.0, 5.2, 2.4}),  wall({7.0, -0.2, 0.0}, {7.2, 5.2, 2.4}),
      wall({0.0, -0.2, 0.0}, {7.0, 0.0, 2.4}),   wall({0.0, 5.0, 0.0}, {7.0, 5.2, 2.4}),
      wall({3.4, 0.0, 0.0}, {3.6, 3.6, 2.4})};
  scene.camera.width = 212;  // an eighth of the pixels: the loop is what is tested
  scene.camera.height = 120;
  return scene;
}

const FlightStart kStart{{1.2, 1.2, 1.2}, 0.0};

FlyOptions options_to(const std::optional<Vector>& goal) {
  FlyOptions options;
  options.goal_m = goal;
  options.time_limit_s = 120.0;
  options.mapper.map.size_m = {16.0, 16.0, 6.0};
  return options;
}

TEST(Fly, comes_to_the_goal_behind_the_wall_and_touches_nothing) {
  const auto report = fly(divided_room(), kStart, options_to(Vector(5.8, 1.2, 1.2)));
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->end, FlightEnd::kArrived) << name_of(report->end);
  EXPECT_LT(report->goal_distance_m, 0.4);
  EXPECT_GT(report->least_clearance_m, 0.05);
  EXPECT_GT(report->length_m, 6.0);  // around the wall
  EXPECT_LT(report->top_speed_mps, 2.3);
}

/// Holds on to the newest map as a page does.
class Onlooker final : public SessionObserver {
 public:
  void map_begun(const Mapper& mapper) override { reader_.emplace(mapper.reader()); }
  void frame_done(const Frame&, const MapUpdate&, const Mapper&) override {
    held_ = reader_->latest();
    ++frames;
  }
  void block_left(const BlockIndex&, const VoxelBlock&, std::uint64_t) override {}

  std::size_t frames = 0;

 private:
  std::optional<MapReader> reader_;
  std::optional<MapSnapshot> held_;
};

TEST(Fly, tells_who_looks_on_what_the_planner_is_at_and_flies_no_differently) {
  const FlyOptions alone = options_to(Vector(5.8, 1.2, 1.2));
  FlyOptions watched = alone;
  std::vector<Course> told;
  watched.on_course = [&](const Course& course) { told.push_back(course); };
  Onlooker onlooker;
  auto map = make_swiftlet_map(watched.mapper, &onlooker);
  ASSERT_TRUE(map);
  const auto report = fly(divided_room(), kStart, watched, std::move(*map));
  const auto unwatched = fly(divided_room(), kStart, alone);
  ASSERT_TRUE(report && unwatched);
  EXPECT_EQ(report->digest, unwatched->digest);
  EXPECT_EQ(onlooker.frames, report->frames);
  ASSERT_GT(told.size(), 50U);
  EXPECT_TRUE(std::ranges::is_sorted(told, {}, &Course::frame_count));
  std::size_t with_path = 0, with_view = 0;
  for (const Course& course : told) {
    EXPECT_EQ(course.goal_m, alone.goal_m);
    with_view += course.looks_at_m ? 1 : 0;
    if (course.path.size() < 2) continue;
    ++with_path;
    ASSERT_TRUE(course.target_m);
    for (const CoursePoint& point : course.path) EXPECT_GE(point.clearance_m, 0.2);
  }
  EXPECT_GT(with_path, 20U);
  EXPECT_GT(with_view, 5U);  // the goal is behind the wall
  EXPECT_FALSE(told.front().frontier.empty());
  EXPECT_LT((told.back().path.back().p_world - *alone.goal_m).norm(), 0.5);
}

TEST(Fly, repeats_to_the_bit_and_differs_by_seed) {
  FlyOptions options = options_to(Vector(5.8, 1.2, 1.2));
  const auto first = fly(divided_room(), kStart, options);
  const auto again = fly(divided_room(), kStart, options);
  options.seed = 2;
  const auto other = fly(divided_room(), kStart, options);
  ASSERT_TRUE(first && again && other);
  EXPECT_EQ(first->digest, again->digest);
  EXPECT_EQ(first->known_m3, again->known_m3);
  EXPECT_NE(first->digest, other->digest);
}

TEST(Fly, explores_the_room_and_comes_home) {
  const auto report = fly(divided_room(), kStart, options_to(std::nullopt));
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->end, FlightEnd::kExplored) << name_of(report->end);
  EXPECT_LT(report->goal_distance_m, 0.4);
  EXPECT_GT(report->known_share, 0.97);
  EXPECT_GT(report->least_clearance_m, 0.05);
}

TEST(Fly, gives_up_on_a_goal_that_nothing_leads_to) {
  sim::Scene scene = divided_room();
  scene.objects.push_back(wall({3.4, 3.6, 0.0}, {3.6, 5.0, 2.4}));
  const auto report = fly(scene, kStart, options_to(Vector(5.8, 1.2, 1.2)));
  ASSERT_TRUE(report) << report.error().text();
  EXPECT_EQ(report->end, FlightEnd::kStuck) << name_of(report->end);
  EXPECT_GT(report->least_clearance_m, 0.05);
}

/// A box that stands beside the room and from 6 s to 8 s flies through the place of the start.
sim::Scene room_with_a_rammer() {
  sim::Scene scene = divided_room();
  const auto path = sim::Flight::create({{0.0, {1.2, -3.0, 1.2}, Eigen::Quaterniond::Identity()},
                                         {6.0, {1.2, -3.0, 1.2}, Eigen::Quaterniond::Identity()},
                                         {8.0, {1.2, 4.0, 1.2}, Eigen::Quaterniond::Identity()}});
  scene.movers.push_back({"box", {wall({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5})}, *path});
  return scene;
}

TEST(Fly, tells_a_collision_whatever_else_ends_the_flight) {
  FlyOptions options = options_to(Vector(1.3, 1.2, 1.2));
  const auto rammed = fly(room_with_a_rammer(), kStart, options);
  ASSERT_TRUE(rammed) << rammed.error().text();
  ASSERT_EQ(rammed->end, FlightEnd::kCollided) << name_of(rammed->end);
  EXPECT_LE(rammed->least_clearance_m, 0.0);
  options.time_limit_s = rammed->time_s - 0.005;  // over in the same tick
  const auto late = fly(room_with_a_rammer(), kStart, options);
  ASSERT_TRUE(late) << late.error().text();
  EXPECT_EQ(late->end, FlightEnd::kCollided) << name_of(late->end);
}

TEST(Fly, refuses_a_goal_where_it_may_not_be) {
  FlyOptions options = options_to(Vector(5.8, 1.2, 1.2));
  options.bounds = SpaceBox{{0, 0, 0}, {3, 5, 2}};
  const auto outside = fly(divided_room(), kStart, options);
  ASSERT_FALSE(outside);
  EXPECT_THAT(outside.error().text(), testing::HasSubstr("outside where the vehicle may be"));
  EXPECT_FALSE(fly(divided_room(), kStart, options_to(Vector(1e10, 0, 0))));
}

TEST(FlightTask, refuses_what_an_address_says_and_a_flight_does_not_heed) {
  EXPECT_TRUE(read_flight_task("random:forest?seed=7"));
  for (const std::string ignored : {"fault=jump", "rate=30", "cameras=4", "noise=off"})
    EXPECT_FALSE(read_flight_task("sim:apartment?" + ignored)) << ignored;
}

TEST(Fly, says_what_it_cannot_begin_with) {
  const auto refused = [](const FlightStart& start, const FlyOptions& options) {
    const auto report = fly(divided_room(), start, options);
    return report ? std::string("it flew") : report.error().text();
  };
  FlyOptions options = options_to(Vector(5.8, 1.2, 1.2));
  EXPECT_THAT(refused({{3.5, 1.0, 1.0}, 0.0}, options), testing::HasSubstr("inside something"));
  options.max_speed_mps = 20.0;
  EXPECT_THAT(refused(kStart, options), testing::HasSubstr("8 m/s at most"));
  options.max_speed_mps = 0.0;
  EXPECT_THAT(refused(kStart, options), testing::HasSubstr("cannot be used"));
  options = options_to(Vector(std::nan(""), 0.0, 0.0));
  EXPECT_THAT(refused(kStart, options), testing::HasSubstr("cannot be used"));
}

}  // namespace
}  // namespace swiftlet
