// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/vehicle/vehicle_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "support/seeds.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;
using std::chrono::milliseconds;

VehicleModel vehicle_with(const VehicleOptions& options = {}, std::uint64_t seed = 1) {
  return VehicleModel::create(options, {.position_m = {0, 0, 1}}, seed).value();
}
Stamp after_s(double seconds) { return {std::llround(seconds * 1e9)}; }

/// Sends a setpoint every 20 ms, as offboard mode wants, and looks at each.
template <class Choose, class Look>
void steer(VehicleModel& vehicle, double until_s, Choose choose, Look look) {
  for (double t = seconds(vehicle.state().stamp - Stamp{}); t < until_s; t += 0.02) {
    ASSERT_TRUE(vehicle.command(choose(t), vehicle.state().stamp));
    vehicle.advance(after_s(t + 0.02));
    look(vehicle.state());
  }
}

TEST(VehicleModel, keeps_to_all_its_limits_whatever_it_is_told) {
  test::for_each_seed(20, [](test::Random& random) {
    const VehicleOptions options;
    VehicleModel vehicle = vehicle_with(options);
    VehicleState last = vehicle.state();
    for (int i = 0; i < 3000; ++i) {
      if (i % 97 == 0) {
        Setpoint setpoint;
        if (random.chance(0.7)) setpoint.position_m = random.vector(-20, 20);
        if (random.chance(0.5)) setpoint.velocity_mps = random.vector(-15, 15);
        if (random.chance(0.3)) setpoint.acceleration_mps2 = random.vector(-20, 20);
        if (random.chance(0.5)) setpoint.yaw_rad = random.real(-10, 10);
        if (random.chance(0.3)) setpoint.yaw_rate_radps = random.real(-5, 5);
        ASSERT_TRUE(vehicle.command(setpoint, vehicle.state().stamp));
      }
      vehicle.advance(vehicle.state().stamp + VehicleModel::kStep);
      const VehicleState& now = vehicle.state();
      const double dt_s = seconds(VehicleModel::kStep);
      // While it brakes from its top speed it may be a little above: the loop is not perfect.
      EXPECT_LE(now.velocity_mps.head<2>().norm(), 1.1 * options.max_speed_mps);
      EXPECT_LE(std::abs(now.velocity_mps.z()), 1.1 * options.max_climb_mps + 0.3);
      EXPECT_LE(now.thrust_mps2.norm(), options.max_acceleration_mps2 + 1e-9);
      EXPECT_LE((now.thrust_mps2 - last.thrust_mps2).norm(), options.max_jerk_mps3 * dt_s + 1e-9);
      EXPECT_LE(std::abs(now.yaw_rate_radps), options.max_yaw_rate_radps + 1e-9);
      EXPECT_LE(std::abs(now.yaw_rate_radps - last.yaw_rate_radps),
                options.max_yaw_acceleration_radps2 * dt_s + 1e-9);
      last = now;
    }
  });
}

TEST(VehicleModel, goes_to_a_place_and_hardly_beyond_it) {
  for (const double distance_m : {0.2, 1.0, 5.0, 20.0}) {
    VehicleModel vehicle = vehicle_with();
    const Vector3d goal(distance_m, 0, 1);
    double farthest_m = 0.0;
    steer(
        vehicle, 4.0 + distance_m, [&](double) { return Setpoint{.position_m = goal}; },
        [&](const VehicleState& s) { farthest_m = std::max(farthest_m, s.position_m.x()); });
    EXPECT_LT((vehicle.state().position_m - goal).norm(), 0.01) << distance_m;
    EXPECT_LT(farthest_m, distance_m + 0.05) << distance_m;
  }
}

TEST(VehicleModel, follows_a_moving_place_closely_if_told_its_velocity) {
  VehicleModel vehicle = vehicle_with();
  const auto circle = [](double t) {
    return Setpoint{.position_m = Vector3d(3 * std::sin(0.5 * t), 3 - 3 * std::cos(0.5 * t), 1),
                    .velocity_mps = Vector3d(1.5 * std::cos(0.5 * t), 1.5 * std::sin(0.5 * t), 0)};
  };
  steer(vehicle, 20.0, circle, [&](const VehicleState& s) {
    const double t = seconds(s.stamp - Stamp{});
    // 50 ms late at 1.5 m/s are 0.08 m; the rest is what turning takes.
    const bool has_caught_up = t > 3.0;
    EXPECT_LT((s.position_m - *circle(t).position_m).norm(), has_caught_up ? 0.3 : 2.0) << t;
  });
}

TEST(VehicleModel, obeys_after_its_latency_and_not_before) {
  VehicleOptions options;
  options.command_latency = milliseconds(120);
  VehicleModel vehicle = vehicle_with(options);
  ASSERT_TRUE(vehicle.command({.velocity_mps = Vector3d(2, 0, 0)}, Stamp{}));
  vehicle.advance(after_s(0.120));
  EXPECT_EQ(vehicle.state().velocity_mps.norm(), 0.0);
  vehicle.advance(after_s(0.122));
  EXPECT_GT(vehicle.state().velocity_mps.x(), 0.0);
}

TEST(VehicleModel, stops_and_stays_when_no_command_comes_any_more) {
  VehicleModel vehicle = vehicle_with();
  steer(
      vehicle, 2.0, [](double) { return Setpoint{.velocity_mps = Vector3d(3, 0, 0)}; },
      [](const VehicleState&) {});
  EXPECT_NEAR(vehicle.state().velocity_mps.x(), 3.0, 0.1);
  EXPECT_FALSE(vehicle.is_lost());
  vehicle.advance(after_s(5.0));
  EXPECT_TRUE(vehicle.is_lost());
  const Vector3d stopped = vehicle.state().position_m;
  vehicle.advance(after_s(60.0));
  EXPECT_LT((vehicle.state().position_m - stopped).norm(), 0.01);
}

TEST(VehicleModel, turns_the_shorter_way_and_stops_at_the_heading) {
  VehicleModel vehicle = vehicle_with();
  steer(
      vehicle, 6.0, [](double) { return Setpoint{.yaw_rad = 3.0}; }, [](const VehicleState&) {});
  EXPECT_NEAR(vehicle.state().yaw_rad, 3.0, 0.01);
  steer(
      vehicle, 12.0, [](double) { return Setpoint{.yaw_rad = -3.0}; },
      [](const VehicleState& s) { EXPECT_GT(s.yaw_rad, 2.9); });
  EXPECT_NEAR(vehicle.state().yaw_rad, 2.0 * std::numbers::pi - 3.0, 0.01);
}

TEST(VehicleModel, leans_into_its_acceleration_and_keeps_its_heading) {
  VehicleState state{.thrust_mps2 = {9.81, 0, 0}, .yaw_rad = 0.7};
  const auto leaning = state.T_world_body().rotation();
  EXPECT_NEAR((leaning * Vector3d::UnitZ()).dot(Vector3d(1, 0, 1).normalized()), 1.0, 1e-12);
  const Vector3d nose = leaning * Vector3d::UnitX();
  EXPECT_LT(nose.z(), 0.0);  // forward is down
  state.tilts = false;
  EXPECT_NEAR(std::atan2((state.T_world_body().rotation() * Vector3d::UnitX()).y(),
                         (state.T_world_body().rotation() * Vector3d::UnitX()).x()),
              0.7, 1e-12);
}

TEST(VehicleModel, repeats_a_flight_to_the_bit_however_often_it_is_asked) {
  VehicleOptions windy;
  windy.wind.gust_mps = 2.0;
  const auto flown = [&](std::uint64_t seed, milliseconds pieces) {
    VehicleModel vehicle = vehicle_with(windy, seed);
    EXPECT_TRUE(vehicle.command({.position_m = Vector3d(2, 3, 2), .yaw_rad = 1.0}, Stamp{}));
    for (Stamp t{}; t < after_s(0.4); t = t + pieces) vehicle.advance(t);
    vehicle.advance(after_s(0.4));
    return vehicle.state();
  };
  EXPECT_EQ(flown(1, milliseconds(1)).position_m, flown(1, milliseconds(33)).position_m);
  EXPECT_NE(flown(1, milliseconds(1)).position_m, flown(2, milliseconds(1)).position_m);
}

TEST(VehicleModel, holds_its_place_in_a_steady_wind_once_it_has_learnt_it) {
  VehicleOptions windy;
  windy.wind.mean_mps = {4, -2, 0};
  VehicleModel vehicle = vehicle_with(windy);
  double farthest_m = 0.0;
  steer(
      vehicle, 15.0, [](double) { return Setpoint{.position_m = Vector3d(0, 0, 1)}; },
      [&](const VehicleState& s) {
        farthest_m = std::max(farthest_m, (s.position_m - Vector3d(0, 0, 1)).norm());
      });
  EXPECT_GT(farthest_m, 0.02);  // it blows
  EXPECT_LT(farthest_m, 0.5);
  EXPECT_LT((vehicle.state().position_m - Vector3d(0, 0, 1)).norm(), 0.02);
}

TEST(VehicleModel, refuses_what_is_no_number) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  VehicleModel vehicle = vehicle_with();
  EXPECT_FALSE(vehicle.command({.position_m = Vector3d(0, nan, 0)}, Stamp{}));
  EXPECT_FALSE(vehicle.command({.yaw_rad = nan}, Stamp{}));
  VehicleOptions options;
  options.max_jerk_mps3 = 0.0;
  EXPECT_FALSE(VehicleModel::create(options, {}, 1));
  options = {};
  options.wind.gust_mps = nan;
  EXPECT_FALSE(VehicleModel::create(options, {}, 1));
  EXPECT_FALSE(VehicleModel::create({}, {.position_m = {nan, 0, 0}}, 1));
}

}  // namespace
}  // namespace swiftlet::sim
