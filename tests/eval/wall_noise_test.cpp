// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/camera/wall_noise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/seeds.hpp"

namespace swiftlet::eval {
namespace {

/// A wall, tilted by a slope of depth to the right, with the noise of a stereo camera.
DepthImage wall(const PinholeIntrinsics& intrinsics, double distance_m, double slope, double s_px,
                test::Random& random) {
  constexpr double kBaseline_m = 0.05;
  DepthImage depth{Image<std::uint16_t>(intrinsics.width(), intrinsics.height()), 0.0001F};
  for (int v = 0; v < intrinsics.height(); ++v) {
    for (int u = 0; u < intrinsics.width(); ++u) {
      const double x = (u - intrinsics.cx()) / intrinsics.fx();
      const double z_m = distance_m / (1.0 - slope * x);  // z = distance + slope x z
      const double noise_m = random.gaussian(z_m * z_m * s_px / (intrinsics.fx() * kBaseline_m));
      depth.raw.at(u, v) = static_cast<std::uint16_t>(std::lround((z_m + noise_m) * 1e4));
    }
  }
  return depth;
}

TEST(WallNoise, recovers_the_disparity_error_of_straight_and_tilted_walls) {
  const auto intrinsics = PinholeIntrinsics::from_field_of_view(240, 160, 1.5).value();
  test::for_each_seed(8, [&](test::Random& random) {
    const double s_px = random.real(0.03, 0.15), slope = random.real(-0.3, 0.3);
    std::vector<WallNoise> walls;
    for (const double distance_m : {1.0, 2.0, 4.0}) {
      const auto measured =
          measure_wall(wall(intrinsics, distance_m, slope, s_px, random), intrinsics);
      ASSERT_TRUE(measured);
      EXPECT_NEAR(measured->distance_m, distance_m, 0.05 * distance_m);
      EXPECT_NEAR(measured->tilt_rad, std::atan(std::abs(slope)), 0.02);
      walls.push_back(*measured);
    }
    // 4240 readings a wall: 1 % of statistics, and the mean of z^2 over a tilted wall.
    EXPECT_NEAR(fit_subpixel_px(walls, intrinsics.fx(), 0.05), s_px, 0.05 * s_px);
  });
}

TEST(WallNoise, needs_a_hundred_readings) {
  const auto intrinsics = PinholeIntrinsics::from_field_of_view(60, 60, 1.5).value();
  DepthImage depth{Image<std::uint16_t>(60, 60), 0.001F};
  EXPECT_FALSE(measure_wall(depth, intrinsics));
}

}  // namespace
}  // namespace swiftlet::eval
