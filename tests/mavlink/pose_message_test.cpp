// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/pose_message.hpp"

#include <gtest/gtest.h>

#include "support/seeds.hpp"
#include "swiftlet/mavlink/companion/frd_axes.hpp"
#include "swiftlet/mavlink/companion/mapped_frame.hpp"

namespace swiftlet::mavlink {
namespace {

using namespace std::chrono_literals;
using test::Random;

MappedFrame posed(const Eigen::Quaterniond& R, const Eigen::Vector3d& t, HostTime taken_at = {}) {
  return {.T_world_body = Transform<World, Body>::trusted(R, t), .taken_at = taken_at};
}

Eigen::Quaterniond rotation_of(const Odometry& m) {
  return Eigen::Quaternionf(m.q[0], m.q[1], m.q[2], m.q[3]).cast<double>();
}

TEST(Odometry, maps_points_of_the_turned_body_to_the_turned_world) {
  test::for_each_seed(1000, [](Random& random) {
    const MappedFrame frame = posed(random.rotation(), random.vector(-50, 50));
    const Odometry message = odometry_of(frame, {}, 0, 0);
    const Eigen::Vector3d p_body = random.vector(-1, 1);
    const Eigen::Vector3d p_frd = rotation_of(message) * turned_about_x(p_body) +
                                  Eigen::Vector3d(message.x, message.y, message.z);
    EXPECT_LT((p_frd - turned_about_x(frame.T_world_body * p_body)).norm(), 2e-5);  // floats of 50
  });
}

TEST(Odometry, is_level_and_points_ahead_as_the_vehicle_does) {
  const Eigen::Quaterniond left(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ()));
  const Odometry turned = odometry_of(posed(left, {1, 2, 3}), {}, 9, 4);
  EXPECT_FLOAT_EQ(turned.x, 1);
  EXPECT_FLOAT_EQ(turned.y, -2);
  EXPECT_FLOAT_EQ(turned.z, -3);
  EXPECT_LT(turned.q[3], 0);  // left is against the clock that z down counts by
  EXPECT_FLOAT_EQ(turned.q[1], 0);
  EXPECT_EQ(turned.reset_counter, 4);
  EXPECT_EQ(turned.time_usec, 9U);
}

TEST(Odometry, tells_the_motion_of_a_body_that_flies_a_circle) {
  // 2 m/s ahead, turning left by 0.5 rad/s.
  const auto at = [](double t) {
    const double a = 0.5 * t;
    return posed(Eigen::Quaterniond(Eigen::AngleAxisd(a, Eigen::Vector3d::UnitZ())),
                 {4 * std::sin(a), 4 - 4 * std::cos(a), 0},
                 HostTime(std::chrono::nanoseconds(static_cast<std::int64_t>(1e9 * t))));
  };
  const Odometry message = odometry_of(at(1.03), motion_between(at(1.0), at(1.03)), 0, 0);
  EXPECT_NEAR(message.vx, 2, 0.01);
  EXPECT_NEAR(message.vy, 0, 0.05);
  EXPECT_NEAR(message.vz, 0, 1e-6);
  EXPECT_NEAR(message.yawspeed, -0.5, 1e-4);
}

TEST(Odometry, has_variances_and_quality_of_the_tracker_s_confidence) {
  float last = 1e9F;
  std::int8_t quality = -2;
  for (std::uint8_t confidence = 0; confidence <= 3; ++confidence) {
    MappedFrame frame;
    frame.confidence = confidence;
    const Odometry message = odometry_of(frame, {}, 0, 0);
    EXPECT_LT(message.pose_covariance[0], last);
    for (const std::size_t i : {0, 6, 11, 15, 18, 20})
      EXPECT_EQ(message.pose_covariance[i], message.pose_covariance[0]);
    EXPECT_GT(message.quality, quality);
    last = message.pose_covariance[0];
    quality = message.quality;
  }
  EXPECT_EQ(quality, 100);
}

TEST(VisionPosition, has_the_angles_that_make_the_same_rotation) {
  test::for_each_seed(1000, [](Random& random) {
    const MappedFrame frame = posed(random.rotation(), random.vector(-5, 5));
    const VisionPositionEstimate m = vision_position_of(frame, 0, 0);
    const auto turn = [](float angle, const Eigen::Vector3d& axis) {
      return Eigen::AngleAxisd(static_cast<double>(angle), axis);
    };
    const Eigen::Quaterniond R(turn(m.yaw, Eigen::Vector3d::UnitZ()) *
                               turn(m.pitch, Eigen::Vector3d::UnitY()) *
                               turn(m.roll, Eigen::Vector3d::UnitX()));
    EXPECT_LT(R.angularDistance(turned_about_x(frame.T_world_body.rotation())), 1e-3);
  });
}

Frame some_frame() {
  return {.stamp = {},
          .depth = {},
          .intrinsics = *PinholeIntrinsics::create(8, 8, 8, 8, 4, 4),
          .T_world_camera = {}};
}

TEST(MappedFrame, was_taken_when_its_stamp_says_if_that_is_of_this_computer_s_clock) {
  const HostTime now{1000s};
  const Stamp unix_now{1'700'000'000'000'000'000};
  Frame frame = some_frame();
  frame.stamp = unix_now - 40ms;
  EXPECT_EQ(mapped_frame(frame, {}, now, unix_now).taken_at, now - 40ms);
  frame.stamp = {5};  // of a recording
  EXPECT_EQ(mapped_frame(frame, {}, now, unix_now).taken_at, now);
  frame.seen_at = now - 7ms;
  EXPECT_EQ(mapped_frame(frame, {}, now, unix_now).taken_at, now - 7ms);
  frame.stamp = unix_now + 1ms;  // the clock was set back
  EXPECT_EQ(mapped_frame(frame, {}, now, unix_now).taken_at, now - 7ms);
}

TEST(MappedFrame, has_the_vehicle_s_nose_where_the_mount_says_or_else_where_the_camera_looks) {
  Frame frame = some_frame();
  frame.T_world_camera = Transform<World, Camera>::trusted(forward_looking_camera().rotation(),
                                                           {1, 2, 3});  // looks along the world's x
  const auto nose = [&](const Transform<Body, Camera>& mount) {
    const auto T_world_body = mapped_frame(frame, mount, {}, {}).T_world_body;
    return Eigen::Vector3d(T_world_body.rotation() * Eigen::Vector3d::UnitX());
  };
  EXPECT_LT((nose({}) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  EXPECT_LT((nose(forward_looking_camera()) - Eigen::Vector3d::UnitX()).norm(), 1e-12);
  // A camera that looks to the left of the vehicle: the nose is to the right of what it sees.
  const Eigen::Quaterniond left(Eigen::AngleAxisd(1.5707963267948966, Eigen::Vector3d::UnitZ()));
  const auto sideways = Transform<Body, Camera>::trusted(left * forward_looking_camera().rotation(),
                                                         Eigen::Vector3d::Zero());
  EXPECT_LT((nose(sideways) + Eigen::Vector3d::UnitY()).norm(), 1e-12);
}

}  // namespace
}  // namespace swiftlet::mavlink
