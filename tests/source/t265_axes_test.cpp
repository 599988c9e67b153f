// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/t265_axes.hpp"

#include <gtest/gtest.h>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

/// The law of the header, in matrices.
Eigen::Matrix4d converted(const Eigen::Quaterniond& R, const Eigen::Vector3d& t) {
  Eigen::Matrix4d C = Eigen::Matrix4d::Identity();
  C.topLeftCorner<3, 3>() << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  Eigen::Matrix4d T = Eigen::Matrix4d::Identity();
  T.topLeftCorner<3, 3>() = R.toRotationMatrix();
  T.topRightCorner<3, 1>() = t;
  return C * T * C.inverse();
}

TEST(T265Axes, convert_poses_as_c_t_c_inverse) {
  test::Random random;
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Quaterniond R = random.rotation();
    const Eigen::Vector3d t = random.vector(-10, 10);
    const PoseSample pose = from_t265(Stamp{7}, R, t, 2);
    const Eigen::Matrix4d expected = converted(R, t);
    EXPECT_LT((pose.R_world_body.toRotationMatrix() - expected.topLeftCorner<3, 3>()).norm(), 1e-12)
        << random.repeat();
    EXPECT_LT((pose.t_world_body_m - expected.topRightCorner<3, 1>()).norm(), 1e-12);
    EXPECT_EQ(pose.stamp, Stamp{7});
    EXPECT_EQ(pose.confidence, 2);
  }
}

TEST(T265Axes, forward_is_minus_z_left_is_minus_x_up_is_y) {
  using Eigen::Vector3d;
  EXPECT_EQ(from_t265_axes(Vector3d(0, 0, -1)), Vector3d(1, 0, 0));
  EXPECT_EQ(from_t265_axes(Vector3d(-1, 0, 0)), Vector3d(0, 1, 0));
  EXPECT_EQ(from_t265_axes(Vector3d(0, 1, 0)), Vector3d(0, 0, 1));
}

TEST(T265Axes, a_left_turn_about_its_y_is_a_left_turn_about_our_z) {
  const Eigen::Quaterniond left(Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitY()));
  const Eigen::Vector3d ahead = from_t265_axes(left) * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(ahead.y(), std::sin(0.3), 1e-12);
  EXPECT_NEAR(ahead.z(), 0.0, 1e-12);
}

}  // namespace
}  // namespace swiftlet
