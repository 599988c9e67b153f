// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/camera/fill.hpp"

#include <gtest/gtest.h>

namespace swiftlet::eval {
namespace {

TEST(Fill, counts_pixels_with_a_reading_in_the_image_and_in_its_middle_fifth) {
  DepthImage depth{Image<std::uint16_t>(50, 20, 1000), 0.001F};
  EXPECT_EQ(measure_fill(depth).valid, 1000U);
  EXPECT_EQ(measure_fill(depth).of_middle, 1.0);
  for (int v = 8; v < 12; ++v) depth.raw.at(25, v) = 0;  // one column of the ten in the middle
  for (int v = 0; v < 20; ++v) depth.raw.at(0, v) = 0;
  const Fill fill = measure_fill(depth);
  EXPECT_EQ(fill.valid, 976U);
  EXPECT_DOUBLE_EQ(fill.of_image, 0.976);
  EXPECT_DOUBLE_EQ(fill.of_middle, 0.9);
}

}  // namespace
}  // namespace swiftlet::eval
