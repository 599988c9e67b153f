// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/frame/intrinsics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numbers>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TEST(PinholeIntrinsics, project_what_they_back_project_onto_the_same_pixel) {
  test::for_each_seed(1000, [](test::Rng& rng) {
    const double f = test::uniform(rng, 100, 2000);
    const auto camera = PinholeIntrinsics::create(848, 480, f, 1.1 * f, 421.5, 238.2).value();
    const double u = test::uniform(rng, -0.5, 847.5);
    const double v = test::uniform(rng, -0.5, 479.5);
    const Eigen::Vector3d p_camera = camera.back_project(u, v, test::uniform(rng, 0.1, 20.0));
    EXPECT_LT((camera.project(p_camera) - Eigen::Vector2d(u, v)).norm(), 1e-9);
  });
}

TEST(PinholeIntrinsics, back_project_to_the_depth_along_the_axis_not_along_the_ray) {
  const auto camera = PinholeIntrinsics::create(640, 480, 500, 500, 320, 240).value();
  EXPECT_EQ(camera.back_project(320, 240, 2.0), Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(camera.back_project(820, 240, 2.0), Eigen::Vector3d(2, 0, 2));
  EXPECT_EQ(camera.back_project(320, 740, 2.0), Eigen::Vector3d(0, 2, 2));
}

TEST(PinholeIntrinsics, from_a_field_of_view_see_exactly_that_far_to_each_side) {
  const double hfov_rad = std::numbers::pi / 2;
  const auto camera = PinholeIntrinsics::from_field_of_view(848, 480, hfov_rad).value();
  EXPECT_NEAR(camera.fx(), 424.0, 1e-9);
  // The outer edges of the first and the last pixel column lie at -45 and +45 degrees.
  EXPECT_NEAR(camera.back_project(-0.5, 0, 1.0).x(), -1.0, 1e-12);
  EXPECT_NEAR(camera.back_project(847.5, 0, 1.0).x(), 1.0, 1e-12);
}

TEST(PinholeIntrinsics, refuse_focal_lengths_that_cannot_be_inverted) {
  for (const double bad : {0.0, -525.0, kNaN, std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(PinholeIntrinsics::create(640, 480, bad, 525, 320, 240)) << bad;
    EXPECT_FALSE(PinholeIntrinsics::create(640, 480, 525, bad, 320, 240)) << bad;
  }
  EXPECT_FALSE(PinholeIntrinsics::create(640, 480, 525, 525, kNaN, 240));
  EXPECT_FALSE(PinholeIntrinsics::create(640, 480, 525, 525, 320, kNaN));
}

TEST(PinholeIntrinsics, refuse_impossible_image_sizes_and_fields_of_view) {
  for (const int side : {-1, 0, 16385}) {
    EXPECT_FALSE(PinholeIntrinsics::create(side, 480, 525, 525, 320, 240)) << side;
    EXPECT_FALSE(PinholeIntrinsics::create(640, side, 525, 525, 320, 240)) << side;
  }
  for (const double hfov_rad : {0.0, -1.0, std::numbers::pi, kNaN})
    EXPECT_FALSE(PinholeIntrinsics::from_field_of_view(640, 480, hfov_rad)) << hfov_rad;
}

}  // namespace
}  // namespace swiftlet
