// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/sweep/speed_limit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::Random;
using Limit = double (*)(double free_m, const Braking&);

double ours(double free_m, const Braking& braking) { return *speed_limit_mps(free_m, braking); }
double textbook(double free_m, const Braking& braking) {
  const double a = braking.deceleration_mps2, t = braking.reaction_s;
  return -a * t + std::sqrt(a * a * t * t + 2.0 * a * free_m);
}

/// A vehicle that is as fast as it may be towards a wall: it learns its limit every now and then,
/// obeys it with the rest of the reaction time as lag, and speeds up or brakes as hard as it can.
/// Returns how far it stops before the wall [m]; negative: behind it.
double rest_before_the_wall(Random& random, Limit limit) {
  const Braking braking{random.real(1.0, 6.0), random.real(0.05, 0.5)};
  const double a = braking.deceleration_mps2;
  const double period = random.real(0.02, std::min(0.12, braking.reaction_s));
  const double lag = braking.reaction_s - period;
  constexpr double kStep = 1e-3;
  double left = random.real(0.5, 9.5), v = 0.0;
  double next_look = 0.0, target = 0.0;
  struct Order {
    double due, limit;
  };
  std::vector<Order> orders;
  for (double now = 0.0; now < 20.0; now += kStep) {
    if (now >= next_look) {
      orders.push_back({now + lag, limit(std::max(0.0, left), braking)});
      next_look += period;
    }
    while (!orders.empty() && orders.front().due <= now) {
      target = orders.front().limit;
      orders.erase(orders.begin());
    }
    const double faster = std::clamp(target - v, -a * kStep, a * kStep);
    left -= (v + 0.5 * faster) * kStep;
    v = std::max(0.0, v + faster);
    if (now > 1.0 && v == 0.0) break;
  }
  return left;
}

TEST(SpeedLimit, is_the_one_that_was_worked_out_by_hand) {
  const Braking braking{4.0, 0.3};
  EXPECT_NEAR(ours(1.0, braking), 0.90, 0.005);
  EXPECT_NEAR(ours(5.0, braking), 4.15, 0.005);
  EXPECT_NEAR(ours(15.0, braking), 8.69, 0.005);
  EXPECT_EQ(ours(0.3, braking), 0.0);
  EXPECT_NEAR(ours(5.0, {4.0, 0.0}), std::sqrt(2.0 * 4.0 * 5.0), 1e-12);
}

TEST(SpeedLimit, lets_a_vehicle_that_still_accelerates_stop_before_the_wall) {
  Random random;
  double nearest = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 20000; ++i) {
    const double left = rest_before_the_wall(random, ours);
    // Rounding of a step of 1 ms at up to 6 m/s^2, as the simulation takes them.
    ASSERT_GT(left, -1e-3) << random.repeat() << ", approach " << i;
    nearest = std::min(nearest, left);
  }
  EXPECT_LT(nearest, 0.1);  // and gives nothing away
}

TEST(SpeedLimit, of_the_textbook_fails_the_same_test) {
  Random random;
  int overran = 0;
  for (int i = 0; i < 500; ++i) overran += rest_before_the_wall(random, textbook) < -1e-3 ? 1 : 0;
  EXPECT_GT(overran, 490);
}

TEST(SpeedLimit, refuses_numbers_that_mean_nothing) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(speed_limit_mps(-1.0, {}));
  EXPECT_FALSE(speed_limit_mps(kNan, {}));
  EXPECT_FALSE(speed_limit_mps(1.0, {0.0, 0.1}));
  EXPECT_FALSE(speed_limit_mps(1.0, {kNan, 0.1}));
  EXPECT_FALSE(speed_limit_mps(1.0, {1.0, -0.1}));
}

}  // namespace
}  // namespace swiftlet
