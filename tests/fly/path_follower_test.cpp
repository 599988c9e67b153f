// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/fly/path_follower.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

constexpr double kDt_s = 0.01;

std::vector<Eigen::Vector3d> random_path(test::Random& random) {
  std::vector<Eigen::Vector3d> points{Eigen::Vector3d::Zero()};
  const int count = random.integer(1, 8);
  for (int i = 0; i < count; ++i) points.push_back(points.back() + random.vector(-2.0, 2.0));
  return points;
}

TEST(PathFollower, comes_to_rest_at_the_end_of_any_path) {
  test::for_each_seed(100, [](test::Random& random) {
    const FollowLimits limits{random.real(0.5, 6.0), random.real(1.0, 5.0), 0.3};
    PathFollower follower(limits, Eigen::Vector3d::Zero());
    const auto points = random_path(random);
    follower.follow(points);
    Eigen::Vector3d last = follower.place_m();
    double speed_mps = 0.0;
    for (int i = 0; i < 20'000 && follower.speed_mps() + follower.left_m() > 1e-4; ++i) {
      follower.advance(kDt_s);
      EXPECT_LE(follower.speed_mps(), limits.max_speed_mps + 1e-9);
      EXPECT_LE(follower.speed_mps() - speed_mps, limits.max_acceleration_mps2 * kDt_s + 1e-9);
      EXPECT_LE((follower.place_m() - last).norm(),
                0.5 * (speed_mps + follower.speed_mps()) * kDt_s + 2e-4);
      speed_mps = follower.speed_mps();
      last = follower.place_m();
    }
    EXPECT_LT((follower.place_m() - points.back()).norm(), 2e-3);
    EXPECT_EQ(follower.speed_mps(), 0.0);
  });
}

TEST(PathFollower, is_never_faster_than_it_can_stop_before_the_end) {
  PathFollower follower({5.0, 3.0, 0.3}, Eigen::Vector3d::Zero());
  follower.follow({{0, 0, 0}, {20, 0, 0}});
  while (follower.left_m() > 0.1) {
    follower.advance(kDt_s);
    EXPECT_LE(follower.stopping_m(), follower.left_m() + 0.05);
  }
}

TEST(PathFollower, slows_down_for_bends) {
  PathFollower follower({4.0, 3.0, 0.3}, Eigen::Vector3d::Zero());
  follower.follow({{0, 0, 0}, {8, 0, 0}, {8, 8, 0}});
  double at_corner_mps = 10.0, fastest_mps = 0.0;
  while (follower.left_m() > 0.1) {
    follower.advance(kDt_s);
    fastest_mps = std::max(fastest_mps, follower.speed_mps());
    if (std::abs(follower.path_m() - 8.0) < 0.05)
      at_corner_mps = std::min(at_corner_mps, follower.speed_mps());
  }
  EXPECT_GT(fastest_mps, 2.0);
  EXPECT_LT(at_corner_mps, 1.2);
}

TEST(PathFollower, stops_where_the_path_is_cut) {
  test::for_each_seed(50, [](test::Random& random) {
    PathFollower follower({3.0, 3.0, 0.3}, Eigen::Vector3d::Zero());
    follower.follow({{0, 0, 0}, {30, 0, 0}});
    const int ticks = random.integer(50, 400);
    for (int i = 0; i < ticks; ++i) follower.advance(kDt_s);
    const double end_m = follower.place_m().x() + 2.0 * follower.stopping_m() + 0.05;
    follower.stop_at(follower.path_m() + 2.0 * follower.stopping_m() + 0.05);
    double last_mps = follower.speed_mps();
    for (int i = 0; i < 3000; ++i) {
      follower.advance(kDt_s);
      EXPECT_LE(last_mps - follower.speed_mps(), 1.6 * 3.0 * kDt_s + kDt_s + 0.4);
      last_mps = follower.speed_mps();
    }
    EXPECT_NEAR(follower.place_m().x(), end_m, 1e-3);
  });
}

TEST(PathFollower, tells_the_vehicle_its_place_and_velocity) {
  PathFollower follower({2.0, 3.0, 0.3}, {1, 2, 3});
  EXPECT_EQ(*follower.setpoint().position_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(follower.setpoint().velocity_mps->isZero());
  follower.follow({{1, 2, 3}, {1, 9, 3}});
  for (int i = 0; i < 100; ++i) follower.advance(kDt_s);
  const auto before = *follower.setpoint().position_m;
  const auto velocity = *follower.setpoint().velocity_mps;
  EXPECT_NEAR(velocity.y(), follower.speed_mps(), 1e-9);
  follower.advance(kDt_s);
  EXPECT_NEAR((*follower.setpoint().position_m - before).y() / kDt_s, velocity.y(), 0.05);
}

}  // namespace
}  // namespace swiftlet
