// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/preprocess/frame_quality.hpp"

#include <gtest/gtest.h>

#include "support/bad_frames.hpp"

namespace swiftlet {
namespace {

DepthImage image_of(std::uint16_t value) { return {Image<std::uint16_t>(64, 48, value), 0.001F}; }

TEST(FrameQuality, shares_are_those_of_the_pixels) {
  DepthImage depth = image_of(1000);
  for (int u = 0; u < 16; ++u) {
    for (int v = 0; v < 48; ++v) depth.raw.at(u, v) = 0;
    for (int v = 0; v < 48; ++v) depth.raw.at(u + 16, v) = 65535;
  }
  const FrameQuality quality = measure_quality(depth);
  EXPECT_DOUBLE_EQ(quality.valid, 0.75);
  EXPECT_DOUBLE_EQ(quality.saturated, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(quality.at_one_value, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(quality.smeared, 0.0);
}

TEST(FrameQuality, of_an_image_without_a_reading_or_a_pixel_is_nothing) {
  for (const DepthImage& depth : {image_of(0), DepthImage{}}) {
    const FrameQuality quality = measure_quality(depth);
    EXPECT_EQ(quality.valid, 0.0);
    EXPECT_EQ(quality.saturated, 0.0);
    EXPECT_EQ(quality.at_one_value, 0.0);
    EXPECT_EQ(quality.smeared, 0.0);
  }
}

TEST(FrameQuality, blur_is_seen_along_rows_and_along_columns_and_sharp_edges_are_none) {
  test::for_each_seed(5, [](test::Random& random) {
    const DepthImage sharp = test::boxes_before_a_wall(random);
    EXPECT_LT(share_of_smeared_edges(sharp), 0.02);
    for (const int length_px : {3, 5, 7, 10}) {
      EXPECT_GT(share_of_smeared_edges(test::smeared(sharp, length_px, 0)), 0.9) << length_px;
      EXPECT_GT(share_of_smeared_edges(test::smeared(sharp, 0, length_px)), 0.9) << length_px;
    }
  });
}

TEST(FrameQuality, edges_with_a_shadow_and_slanted_surfaces_are_no_blur) {
  test::Random random;
  DepthImage shadows = test::boxes_before_a_wall(random);
  for (int v = 0; v < shadows.raw.height(); ++v) {
    const auto row = shadows.raw.row(v);
    for (std::size_t u = 8; u < row.size(); ++u) {
      if (row[u] != 0 && row[u] + 500 < row[u - 8]) row[u] = 0;
    }
  }
  EXPECT_LT(share_of_smeared_edges(shadows), 0.02);

  // A floor from 0.5 m to the horizon, and a wall seen along: 1 / z is linear.
  DepthImage floor{Image<std::uint16_t>(848, 480), 0.001F};
  for (int v = 250; v < 480; ++v) {
    for (int u = 0; u < 848; ++u)
      floor.raw.at(u, v) = static_cast<std::uint16_t>(std::min(65000.0, 1e6 / (v - 240.0)));
  }
  EXPECT_EQ(share_of_smeared_edges(floor), 0.0);
}

}  // namespace
}  // namespace swiftlet
