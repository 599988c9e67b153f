// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/flight.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/seeds.hpp"

namespace swiftlet::sim {
namespace {

constexpr double kMaxTurn_rad = 2.5;

Nanoseconds at_s(double t_s) { return Nanoseconds(std::llround(t_s * 1e9)); }

std::vector<Waypoint> random_waypoints(test::Random& random) {
  std::vector<Waypoint> waypoints{{0.0, random.vector(-5, 5), Eigen::Quaterniond::Identity()}};
  for (int i = 1; i < 8; ++i) {
    const Waypoint& last = waypoints.back();
    const Eigen::AngleAxisd turn(random.real(-kMaxTurn_rad, kMaxTurn_rad),
                                 random.vector(-1, 1).normalized());
    waypoints.push_back({last.time_s + random.real(0.3, 4.0), random.vector(-5, 5),
                         (last.R_world_flyer * turn).normalized()});
  }
  return waypoints;
}

TEST(Flight, is_at_every_waypoint_at_its_time) {
  test::Random random;
  const auto waypoints = random_waypoints(random);
  const auto flight = Flight::create(waypoints).value();
  for (const Waypoint& w : waypoints) {
    const auto T = flight.at(at_s(w.time_s));
    // Times are rounded to nanoseconds; nothing here moves faster than 100 m/s.
    EXPECT_LT((T.translation() - w.position_m).norm(), 1e-7) << random.repeat();
    EXPECT_LT(T.rotation().angularDistance(w.R_world_flyer), 1e-6) << random.repeat();
  }
}

TEST(Flight, changes_its_velocity_without_jumps_even_at_waypoints) {
  test::Random random;
  const auto waypoints = random_waypoints(random);
  const auto flight = Flight::create(waypoints).value();
  constexpr double kStep_s = 1e-4;
  for (std::size_t i = 1; i + 1 < waypoints.size(); ++i) {
    const double t = waypoints[i].time_s;
    const auto before = flight.at(at_s(t - kStep_s)), here = flight.at(at_s(t)),
               after = flight.at(at_s(t + kStep_s));
    const Eigen::Vector3d v0 = (here.translation() - before.translation()) / kStep_s;
    const Eigen::Vector3d v1 = (after.translation() - here.translation()) / kStep_s;
    // A kink would differ by metres per second; a C1 path by step * acceleration (< 700 m/s^2 for
    // 10 m in 0.3 s).
    EXPECT_LT((v1 - v0).norm(), 0.1) << random.repeat();
    EXPECT_LT(before.rotation().angularDistance(here.rotation()) / kStep_s, 0.05);
    EXPECT_LT(after.rotation().angularDistance(here.rotation()) / kStep_s, 0.05);
  }
}

TEST(Flight, never_leaves_the_box_between_neighbouring_waypoints) {
  test::Random random;
  const auto waypoints = random_waypoints(random);
  const auto flight = Flight::create(waypoints).value();
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Waypoint &a = waypoints[i - 1], &b = waypoints[i];
    const Eigen::AlignedBox3d box(a.position_m.cwiseMin(b.position_m).array() - 1e-6,
                                  a.position_m.cwiseMax(b.position_m).array() + 1e-6);
    for (double s = 0.0; s <= 1.0; s += 0.01) {
      EXPECT_TRUE(box.contains(flight.at(at_s(a.time_s + s * (b.time_s - a.time_s))).translation()))
          << random.repeat();
    }
  }
}

TEST(Flight, rests_before_its_first_and_after_its_last_waypoint) {
  const auto flight = Flight::create({{0.0, {1, 2, 3}}, {2.0, {4, 5, 6}}}).value();
  EXPECT_EQ(flight.at(at_s(-1)).translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(flight.at(at_s(9)).translation(), Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(flight.duration(), at_s(2));
}

TEST(Flight, sways_no_further_than_it_says) {
  const auto flight =
      Flight::create({{0.0, {0, 0, 0}}, {20.0, {0, 0, 0}}}, {0.02, 0.1, 2.0}).value();
  double furthest_m = 0.0;
  for (double t = 0; t < 20; t += 0.05)
    furthest_m = std::max(furthest_m, flight.at(at_s(t)).translation().cwiseAbs().maxCoeff());
  EXPECT_LE(furthest_m, 0.02);
  EXPECT_GT(furthest_m, 0.01);
}

TEST(Flight, positive_yaw_turns_left_and_positive_pitch_looks_down) {
  const Eigen::Vector3d forward = Eigen::Vector3d::UnitX();
  EXPECT_GT((rotation_from_ypr(0.1, 0, 0) * forward).y(), 0.0);
  EXPECT_LT((rotation_from_ypr(0, 0.1, 0) * forward).z(), 0.0);
}

TEST(Flight, looks_along_its_x_axis_as_a_camera) {
  const auto flight = Flight::create({{0.0, {1, 2, 3}, rotation_from_ypr(0.5, 0, 0)}}).value();
  const auto T_world_camera = flight.camera_at(Nanoseconds(0));
  const Eigen::Vector3d ahead = T_world_camera * Eigen::Vector3d(0, 0, 1);
  EXPECT_LT((ahead - Eigen::Vector3d(1 + std::cos(0.5), 2 + std::sin(0.5), 3)).norm(), 1e-12);
}

TEST(Flight, refuses_no_waypoints_and_times_that_do_not_rise) {
  EXPECT_FALSE(Flight::create({}).has_value());
  EXPECT_FALSE(Flight::create({{1.0, {0, 0, 0}}, {1.0, {1, 0, 0}}}).has_value());
}

}  // namespace
}  // namespace swiftlet::sim
