// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/condition/depth_step.hpp"

#include <gtest/gtest.h>

#include "support/seeds.hpp"

namespace swiftlet {

void PrintTo(const Registered<MakeDepthStep>& step, std::ostream* out) { *out << step.name; }

namespace {

using test::Random;

Image<std::uint16_t> random_image(Random& random) {
  Image<std::uint16_t> image(random.integer(1, 70), random.integer(1, 50));
  for (std::uint16_t& d : image.pixels()) {
    d = random.chance(0.3) ? std::uint16_t{0}
                           : static_cast<std::uint16_t>(random.integer(1, 65535));
  }
  return image;
}

ConditionOptions random_options(Random& random) {
  ConditionOptions options;
  options.min_range_m = random.real(0.0, 2.0);
  options.max_range_m = random.real(3.0, 60.0);
  options.downsample = random.integer(1, 11);
  return options;
}

class EveryDepthStep : public testing::TestWithParam<Registered<MakeDepthStep>> {};

TEST_P(EveryDepthStep, never_invents_a_reading) {
  Random random;
  for (int trial = 0; trial < 60; ++trial) {
    const Image<std::uint16_t> image = random_image(random);
    ConditionedDepth depth{.raw = image, .unit_m = 0.001F, .ratio = 1, .origin = {}};
    GetParam().make(random_options(random))->apply(depth);
    for (int v = 0; v < depth.raw.height(); ++v) {
      for (int u = 0; u < depth.raw.width(); ++u) {
        if (depth.raw.at(u, v) == 0) continue;
        const PixelOrigin from = depth.origin_of(u, v);
        ASSERT_EQ(depth.raw.at(u, v), image.at(from.u, from.v)) << random.repeat();
      }
    }
  }
}

TEST_P(EveryDepthStep, turns_an_empty_image_into_an_empty_image) {
  ConditionedDepth depth{
      .raw = Image<std::uint16_t>(33, 17), .unit_m = 0.001F, .ratio = 1, .origin = {}};
  GetParam().make(ConditionOptions{})->apply(depth);
  for (const std::uint16_t d : depth.raw.pixels()) ASSERT_EQ(d, 0);
}

TEST_P(EveryDepthStep, gives_the_same_result_with_used_buffers) {
  Random random;
  const ConditionOptions options = random_options(random);
  const auto used = GetParam().make(options);
  for (int trial = 0; trial < 20; ++trial) {
    const Image<std::uint16_t> image = random_image(random);
    ConditionedDepth a{.raw = image, .unit_m = 0.001F, .ratio = 1, .origin = {}};
    ConditionedDepth b = a;
    used->apply(a);
    GetParam().make(options)->apply(b);
    ASSERT_TRUE(std::ranges::equal(a.raw.pixels(), b.raw.pixels())) << random.repeat();
  }
}

INSTANTIATE_TEST_SUITE_P(Registered, EveryDepthStep,
                         testing::ValuesIn(depth_steps().begin(), depth_steps().end()),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

TEST(RangeGate, keeps_readings_on_both_limits_and_drops_the_next_ones) {
  ConditionOptions options;
  options.min_range_m = 0.5;
  options.max_range_m = 2.0;
  Image<std::uint16_t> image(5, 1);
  std::ranges::copy(std::array<std::uint16_t, 5>{499, 500, 2000, 2001, 65535},
                    image.pixels().begin());
  ConditionedDepth depth{.raw = image, .unit_m = 0.001F, .ratio = 1, .origin = {}};
  find_registered(depth_steps(), "range_gate", "depth step")->make(options)->apply(depth);
  EXPECT_EQ(std::vector<std::uint16_t>(depth.raw.pixels().begin(), depth.raw.pixels().end()),
            (std::vector<std::uint16_t>{0, 500, 2000, 0, 0}));
}

// Brute force from the sentence of method 2, over whole images.
TEST(NearDownsample, keeps_the_smallest_valid_reading_of_every_block_with_its_support) {
  Random random;
  for (int trial = 0; trial < 60; ++trial) {
    const Image<std::uint16_t> image = random_image(random);
    ConditionOptions options;
    options.downsample = random.integer(2, 11);
    const int n = options.downsample;
    ConditionedDepth depth{.raw = image, .unit_m = 0.001F, .ratio = 1, .origin = {}};
    find_registered(depth_steps(), "near_downsample", "depth step")->make(options)->apply(depth);
    ASSERT_EQ(depth.raw.width(), (image.width() + n - 1) / n);
    ASSERT_EQ(depth.raw.height(), (image.height() + n - 1) / n);

    Image<std::uint16_t> smallest(depth.raw.width(), depth.raw.height());
    Image<int> valid(depth.raw.width(), depth.raw.height());
    for (int v = 0; v < image.height(); ++v) {
      for (int u = 0; u < image.width(); ++u) {
        const std::uint16_t d = image.at(u, v);
        std::uint16_t& best = smallest.at(u / n, v / n);
        if (d != 0 && (best == 0 || d < best)) best = d;
        valid.at(u / n, v / n) += d != 0 ? 1 : 0;
      }
    }
    Image<int> support(depth.raw.width(), depth.raw.height());
    for (int v = 0; v < image.height(); ++v) {
      for (int u = 0; u < image.width(); ++u) {
        const std::uint16_t d = image.at(u, v);
        support.at(u / n, v / n) += d != 0 && d <= smallest.at(u / n, v / n) * 1.05 ? 1 : 0;
      }
    }
    for (int v = 0; v < depth.raw.height(); ++v) {
      for (int u = 0; u < depth.raw.width(); ++u) {
        ASSERT_EQ(depth.raw.at(u, v), smallest.at(u, v)) << random.repeat();
        ASSERT_EQ(depth.origin.at(u, v).valid, valid.at(u, v)) << random.repeat();
        ASSERT_EQ(depth.origin.at(u, v).support, support.at(u, v)) << random.repeat();
      }
    }
  }
}

}  // namespace
}  // namespace swiftlet
