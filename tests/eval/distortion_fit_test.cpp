// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/camera/distortion_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/seeds.hpp"

namespace swiftlet::eval {
namespace {

const PinholeIntrinsics kLens = PinholeIntrinsics::from_field_of_view(424, 240, 1.59).value();

/// A wall that a camera with a distortion reads: Z_m solves Z_m - (x2 X^2 + ...) = distance, which
/// fixed-point steps find.
WallImages bent_wall(const DepthDistortion& d, double distance_m, double noise_m,
                     test::Random& random) {
  WallImages wall{{}, kLens};
  for (int i = 0; i < 4; ++i) {
    DepthImage depth{Image<std::uint16_t>(kLens.width(), kLens.height()), 0.0005F};
    for (int v = 0; v < kLens.height(); ++v) {
      for (int u = 0; u < kLens.width(); ++u) {
        const Eigen::Vector3d ray = kLens.back_project(u, v, 1.0);
        double z_m = distance_m;
        for (int k = 0; k < 40; ++k) {
          const double x = ray.x() * z_m, y = ray.y() * z_m;
          z_m = distance_m + d.x2_per_m * x * x + d.y2_per_m * y * y + d.x1 * x + d.y1 * y +
                d.offset_m;
        }
        depth.raw.at(u, v) =
            static_cast<std::uint16_t>(std::lround((z_m + random.gaussian(noise_m)) / 0.0005));
      }
    }
    wall.images.push_back(std::move(depth));
  }
  return wall;
}

DepthDistortion random_distortion(test::Random& random) {
  return {random.real(-0.08, 0.08), random.real(-0.08, 0.08), random.real(-0.03, 0.03),
          random.real(-0.03, 0.03), random.real(-0.05, 0.05)};
}

TEST(DistortionFit, recovers_the_distortion_of_a_wall_at_a_known_distance) {
  test::for_each_seed(6, [](test::Random& random) {
    const DepthDistortion d = random_distortion(random);
    const auto fit = fit_distortion(bent_wall(d, 1.4, 0.004, random), 1.4);
    ASSERT_TRUE(fit);
    // 400 000 readings of 4 mm know the middle to 0.02 mm; noise moves X with Z, by less than 1 %.
    EXPECT_NEAR(fit->distortion.x2_per_m, d.x2_per_m, 0.002);
    EXPECT_NEAR(fit->distortion.y2_per_m, d.y2_per_m, 0.004);
    EXPECT_NEAR(fit->distortion.x1, d.x1, 0.001);
    EXPECT_NEAR(fit->distortion.y1, d.y1, 0.001);
    EXPECT_NEAR(fit->distortion.offset_m, d.offset_m, 0.001);
    EXPECT_NEAR(fit->rms_m, 0.004, 0.0005);
  });
}

TEST(DistortionFit, estimates_the_distance_in_the_middle_of_the_image) {
  test::Random random;
  const auto fit = fit_distortion(bent_wall({0.05, 0.05, 0, 0, 0}, 1.7, 0.004, random), {});
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->distance_m, 1.7, 0.002);
  EXPECT_EQ(fit->distortion.offset_m, 0.0);
}

TEST(DistortionFit, what_it_finds_straightens_the_wall_there_and_at_other_distances) {
  test::for_each_seed(6, [](test::Random& random) {
    const DepthDistortion d = random_distortion(random);
    const WallImages near = bent_wall(d, 1.4, 0.004, random),
                     far = bent_wall(d, 2.8, 0.016, random);
    const auto fit = fit_distortion(near, 1.4);
    ASSERT_TRUE(fit);
    EXPECT_LT(worst_error(straightened(near, fit->distortion), 1.4), 0.003);
    EXPECT_LT(worst_error(straightened(far, fit->distortion), 2.8), 0.01);
  });
}

TEST(DistortionFit, is_not_drawn_away_by_something_that_stands_before_the_wall) {
  test::Random random;
  const DepthDistortion d{0.06, 0.06, 0.0, 0.0, 0.0};
  WallImages wall = bent_wall(d, 1.4, 0.004, random);
  for (DepthImage& depth : wall.images) {
    for (int v = 180; v < 240; ++v) {
      for (int u = 200; u < 260; ++u) depth.raw.at(u, v) = 1000;
    }
  }
  const auto fit = fit_distortion(wall, 1.4);
  ASSERT_TRUE(fit);
  EXPECT_NEAR(fit->distortion.x2_per_m, d.x2_per_m, 0.002);
  EXPECT_NEAR(fit->distortion.y2_per_m, d.y2_per_m, 0.004);
}

TEST(DistortionFit, refuses_a_wall_that_does_not_fill_the_image) {
  test::Random random;
  WallImages wall = bent_wall({}, 1.4, 0.004, random);
  for (DepthImage& depth : wall.images) {
    for (int v = 0; v < 240; ++v) {
      for (int u = 0; u < 200; ++u) depth.raw.at(u, v) = 0;
    }
  }
  const auto fit = fit_distortion(wall, 1.4);
  ASSERT_FALSE(fit);
  EXPECT_EQ(fit.error().what, "the wall does not fill the image");
}

TEST(DistortionFit, tells_the_tilt_that_linear_terms_may_be) {
  EXPECT_NEAR(tilt_rad({0.0, 0.0, 0.1, 0.0, 0.0}), std::atan(0.1), 1e-12);
}

}  // namespace
}  // namespace swiftlet::eval
