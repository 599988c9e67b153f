// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/frame_of.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::Random;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Points and translations reach 100 m; a product rounds a few times at 1e-16 * 200 m.
constexpr double kRounding_m = 1e-12;

template <class To, class From>
Transform<To, From> any_transform(Random& random) {
  const auto R = random.rotation();
  return Transform<To, From>::from(R, random.vector(-100.0, 100.0)).value();
}

template <class To, class From>
Eigen::Matrix4d matrix_of(const Transform<To, From>& T) {
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.topLeftCorner<3, 3>() = T.rotation().toRotationMatrix();
  M.topRightCorner<3, 1>() = T.translation();
  return M;
}

TEST(Transform, composes_as_its_matrices_do) {
  test::for_each_seed(500, [](Random& random) {
    const auto T_world_body = any_transform<World, Body>(random);
    const auto T_body_camera = any_transform<Body, Camera>(random);
    const Eigen::Matrix4d product = matrix_of(T_world_body) * matrix_of(T_body_camera);
    EXPECT_TRUE(matrix_of(T_world_body * T_body_camera).isApprox(product, 1e-13));
  });
}

TEST(Transform, applied_after_another_equals_the_composition) {
  test::for_each_seed(500, [](Random& random) {
    const auto T_world_body = any_transform<World, Body>(random);
    const auto T_body_camera = any_transform<Body, Camera>(random);
    const Eigen::Vector3d p_camera = random.vector(-100.0, 100.0);
    EXPECT_LT(
        (T_world_body * (T_body_camera * p_camera) - (T_world_body * T_body_camera) * p_camera)
            .norm(),
        kRounding_m);
  });
}

TEST(Transform, followed_by_its_inverse_is_the_identity) {
  test::for_each_seed(500, [](Random& random) {
    const auto T_world_camera = any_transform<World, Camera>(random);
    const Eigen::Vector3d p = random.vector(-100.0, 100.0);
    EXPECT_LT((T_world_camera.inverse() * (T_world_camera * p) - p).norm(), kRounding_m);
    EXPECT_LT((T_world_camera * (T_world_camera.inverse() * p) - p).norm(), kRounding_m);
  });
}

TEST(Transform, stays_unit_through_a_thousand_compositions) {
  test::for_each_seed(5, [](Random& random) {
    Transform<World, World> T;
    for (int i = 0; i < 1000; ++i) T = T * any_transform<World, World>(random);
    EXPECT_NEAR(T.rotation().norm(), 1.0, 1e-15);
  });
}

TEST(Transform, read_from_a_matrix_gives_that_matrix_back) {
  test::for_each_seed(500, [](Random& random) {
    const Eigen::Matrix4d M = matrix_of(any_transform<World, Camera>(random));
    EXPECT_TRUE(matrix_of(Transform<World, Camera>::from_matrix(M).value()).isApprox(M, 1e-13));
  });
}

TEST(Transform, cleans_a_rotation_that_was_written_with_four_digits) {
  test::for_each_seed(200, [](Random& random) {
    const Eigen::Matrix4d exact = matrix_of(any_transform<World, Camera>(random));
    const Eigen::Matrix4d written =
        exact.unaryExpr([](double v) { return std::round(v * 1e4) / 1e4; });
    Eigen::Matrix4d M = written;
    M.row(3) << 0, 0, 0, 1;
    const auto T = Transform<World, Camera>::from_matrix(M);
    ASSERT_TRUE(T) << T.error().text();
    // Nine entries rounded by at most 5e-5 each: the nearest rotation is within twice their norm.
    EXPECT_LT((T->rotation().toRotationMatrix() - exact.topLeftCorner<3, 3>()).norm(), 3e-4);
    EXPECT_NEAR(T->rotation().norm(), 1.0, 1e-15);
  });
}

TEST(Transform, refuses_nan_and_infinity_in_every_entry) {
  for (const double bad : {kNaN, kInfinity, -kInfinity}) {
    for (Eigen::Index i = 0; i < 16; ++i) {
      Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
      M(i) = bad;
      const auto T = Transform<World, Camera>::from_matrix(M);
      ASSERT_FALSE(T) << "entry " << i << " = " << bad;
      EXPECT_THAT(T.error().what, testing::HasSubstr("not finite")) << "entry " << i;
    }
    for (Eigen::Index i = 0; i < 4; ++i) {
      Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
      q.coeffs()(i) = bad;
      EXPECT_FALSE((Transform<World, Body>::from(q, Eigen::Vector3d::Zero())));
    }
  }
}

TEST(Transform, refuses_what_is_no_rotation) {
  const auto refused = [](const Eigen::Matrix3d& R) {
    Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
    M.topLeftCorner<3, 3>() = R;
    const auto T = Transform<World, Camera>::from_matrix(M);
    return !T && T.error().code == ErrorCode::kCorruptInput;
  };
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  EXPECT_TRUE(refused(Eigen::Matrix3d::Zero()));
  EXPECT_TRUE(refused(1.01 * I)) << "scale";
  EXPECT_TRUE(refused(-I)) << "a reflection is orthonormal but no rotation";
  Eigen::Matrix3d sheared = I;
  sheared(0, 1) = 0.01;
  EXPECT_TRUE(refused(sheared));
  EXPECT_FALSE(refused(I));
}

TEST(Transform, refuses_a_quaternion_that_is_not_unit) {
  for (const double length : {0.0, 0.5, 0.998, 1.002, 2.0}) {
    const Eigen::Quaterniond q(length, 0, 0, 0);
    EXPECT_FALSE((Transform<World, Body>::from(q, Eigen::Vector3d::Zero()))) << length;
  }
  const auto nearly = Transform<World, Body>::from(Eigen::Quaterniond(1.0005, 0, 0, 0), {1, 2, 3});
  ASSERT_TRUE(nearly);
  EXPECT_DOUBLE_EQ(nearly->rotation().norm(), 1.0);
}

TEST(Transform, refuses_a_matrix_whose_last_row_is_not_0001) {
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.row(3) << 0, 0, 0.1, 1;
  EXPECT_FALSE((Transform<World, Camera>::from_matrix(M)));
}

TEST(ForwardLookingCamera, sees_forward_as_z_left_as_minus_x_and_up_as_minus_y) {
  const auto T_body_camera = forward_looking_camera();
  EXPECT_TRUE((T_body_camera * Eigen::Vector3d(0, 0, 1)).isApprox(Eigen::Vector3d(1, 0, 0)));
  EXPECT_TRUE((T_body_camera * Eigen::Vector3d(-1, 0, 0)).isApprox(Eigen::Vector3d(0, 1, 0)));
  EXPECT_TRUE((T_body_camera * Eigen::Vector3d(0, -1, 0)).isApprox(Eigen::Vector3d(0, 0, 1)));
}

}  // namespace
}  // namespace swiftlet
