// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/preprocess/depth_step.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

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

PreprocessOptions random_options(Random& random) {
  PreprocessOptions options;
  options.min_range_m = random.real(0.0, 2.0);
  options.max_range_m = random.real(3.0, 60.0);
  options.downsample = random.integer(1, 11);
  options.distortion = {random.real(-0.2, 0.2), random.real(-0.2, 0.2), random.real(-0.1, 0.1),
                        random.real(-0.1, 0.1), random.real(-0.1, 0.1)};
  return options;
}

PreprocessedDepth in_mm(const Image<std::uint16_t>& image) {
  PreprocessedDepth depth;
  depth.raw = image;
  const double width = image.width(), height = image.height();
  depth.intrinsics = PinholeIntrinsics::create(image.width(), image.height(), 40.0, 50.0,
                                               0.4 * width, 0.6 * height)
                         .value();
  return depth;
}

/// Steps that may move a reading, though never out of nothing.
bool moves_readings(std::string_view name) { return name == "smooth" || name == "distortion"; }

class EveryDepthStep : public testing::TestWithParam<Registered<MakeDepthStep>> {};

TEST_P(EveryDepthStep, never_invents_a_reading) {
  Random random;
  for (int trial = 0; trial < 60; ++trial) {
    const Image<std::uint16_t> image = random_image(random);
    PreprocessedDepth depth = in_mm(image);
    GetParam().make(random_options(random))->apply(depth);
    for (int v = 0; v < depth.raw.height(); ++v) {
      for (int u = 0; u < depth.raw.width(); ++u) {
        if (depth.raw.at(u, v) == 0) continue;
        const PixelOrigin from = depth.origin_of(u, v);
        ASSERT_NE(image.at(from.u, from.v), 0) << random.repeat();
        if (moves_readings(GetParam().name)) continue;
        ASSERT_EQ(depth.raw.at(u, v), image.at(from.u, from.v)) << random.repeat();
      }
    }
  }
}

TEST_P(EveryDepthStep, turns_an_empty_image_into_an_empty_image) {
  PreprocessedDepth depth = in_mm(Image<std::uint16_t>(33, 17));
  GetParam().make(PreprocessOptions{})->apply(depth);
  for (const std::uint16_t d : depth.raw.pixels()) ASSERT_EQ(d, 0);
}

TEST_P(EveryDepthStep, gives_the_same_result_with_used_buffers) {
  Random random;
  const PreprocessOptions options = random_options(random);
  const auto used = GetParam().make(options);
  for (int trial = 0; trial < 20; ++trial) {
    const Image<std::uint16_t> image = random_image(random);
    PreprocessedDepth a = in_mm(image);
    PreprocessedDepth b = a;
    used->apply(a);
    GetParam().make(options)->apply(b);
    ASSERT_TRUE(std::ranges::equal(a.raw.pixels(), b.raw.pixels())) << random.repeat();
  }
}

INSTANTIATE_TEST_SUITE_P(Registered, EveryDepthStep,
                         testing::ValuesIn(depth_steps().begin(), depth_steps().end()),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

TEST(RangeGate, keeps_readings_on_both_limits_and_drops_the_next_ones) {
  PreprocessOptions options;
  options.min_range_m = 0.5;
  options.max_range_m = 2.0;
  Image<std::uint16_t> image(5, 1);
  std::ranges::copy(std::array<std::uint16_t, 5>{499, 500, 2000, 2001, 65535},
                    image.pixels().begin());
  PreprocessedDepth depth = in_mm(image);
  find_registered(depth_steps(), "range_gate", "depth step")->make(options)->apply(depth);
  EXPECT_EQ(std::vector<std::uint16_t>(depth.raw.pixels().begin(), depth.raw.pixels().end()),
            (std::vector<std::uint16_t>{0, 500, 2000, 0, 0}));
}

/// Whether two readings belong to one surface, from the definition.
bool agree(int a, int z, const PreprocessedDepth& depth) {
  const auto d = static_cast<float>(z);
  const float square = 3.0F * 1.41421356F * depth.sigma_per_z2 * depth.unit_m;
  const float most = std::min(1300.0F, d - 1.0F);
  const float tolerance = std::max(0.0F, std::min(1.0F + 0.01F * d + square * d * d, most));
  return a != 0 && z != 0 && std::abs(a - z) <= static_cast<int>(tolerance);
}

/// Surfaces with edges, noise and holes.
Image<std::uint16_t> noisy_steps(Random& random) {
  Image<std::uint16_t> image(random.integer(1, 90), random.integer(1, 40));
  for (int v = 0; v < image.height(); ++v) {
    for (int u = 0; u < image.width(); ++u) {
      const double z = (u / 7 + v / 9) % 3 == 0 ? 800.0 : 3500.0 + 40.0 * v;
      const double noisy = z + random.gaussian(z * z * 4e-6);
      image.at(u, v) = random.chance(0.1) ? std::uint16_t{0} : static_cast<std::uint16_t>(noisy);
    }
  }
  return image;
}

// Brute force from the definitions, whatever the width is against that of a vector.
TEST(NeighbourSteps, do_what_a_loop_over_all_neighbours_does) {
  test::for_each_seed(30, [](Random& random) {
    const Image<std::uint16_t> image = noisy_steps(random);
    PreprocessedDepth lone = in_mm(image);
    PreprocessedDepth smooth = lone;
    find_registered(depth_steps(), "lone_pixels", "step")->make({})->apply(lone);
    find_registered(depth_steps(), "smooth", "step")->make({})->apply(smooth);
    EXPECT_LT(smooth.noise_left, 1.0F);
    for (int v = 0; v < image.height(); ++v) {
      for (int u = 0; u < image.width(); ++u) {
        const int z = image.at(u, v);
        int support = 0, count = 0, sum = 0;
        for (int b = std::max(v - 2, 0); b <= std::min(v + 2, image.height() - 1); ++b) {
          for (int a = std::max(u - 2, 0); a <= std::min(u + 2, image.width() - 1); ++a) {
            if (!agree(image.at(a, b), z, lone)) continue;
            ++count;
            sum += image.at(a, b) - z;
            support += std::abs(a - u) <= 1 && std::abs(b - v) <= 1 ? 1 : 0;
          }
        }
        EXPECT_EQ(lone.raw.at(u, v), support > 2 ? z : 0) << u << " " << v;
        const double mean = z == 0 || support < 3 ? 0.0 : z + static_cast<double>(sum) / count;
        EXPECT_NEAR(smooth.raw.at(u, v), mean, 0.51) << u << " " << v;
      }
    }
  });
}

TEST(LonePixels, drops_what_floats_between_fore_and_background_and_keeps_a_rod_of_two_pixels) {
  Image<std::uint16_t> image(20, 20, 3000);
  for (int v = 0; v < 20; ++v) image.at(10, v) = image.at(11, v) = 1000;
  image.at(9, 5) = 1700;  // between the rod and the wall
  image.at(4, 4) = 500;   // mismatch
  PreprocessedDepth depth = in_mm(image);
  find_registered(depth_steps(), "lone_pixels", "step")->make({})->apply(depth);
  EXPECT_EQ(depth.raw.at(9, 5), 0);
  EXPECT_EQ(depth.raw.at(4, 4), 0);
  for (int v = 0; v < 20; ++v) EXPECT_EQ(depth.raw.at(10, v), 1000);
}

TEST(Smooth, leaves_a_third_of_the_noise_of_a_wall_and_its_depth) {
  Random random;
  Image<std::uint16_t> image(200, 100);
  for (std::uint16_t& d : image.pixels())
    d = static_cast<std::uint16_t>(std::lround(4000.0 + random.gaussian(64.0)));
  PreprocessedDepth depth = in_mm(image);
  find_registered(depth_steps(), "smooth", "step")->make({})->apply(depth);
  double sum = 0.0, squares = 0.0;
  for (const std::uint16_t d : depth.raw.pixels()) {
    sum += d - 4000.0;
    squares += (d - 4000.0) * (d - 4000.0);
  }
  const double n = 200.0 * 100.0;
  EXPECT_NEAR(sum / n, 0.0, 2.0);
  EXPECT_LT(std::sqrt(squares / n), 0.3 * 64.0) << "as it tells the map";
}

// Eq. A.3 in doubles, term by term.
TEST(Distortion, subtracts_the_polynomial_of_the_point_that_was_read) {
  test::for_each_seed(40, [](Random& random) {
    const Image<std::uint16_t> image = random_image(random);
    const PreprocessOptions options = random_options(random);
    const DepthDistortion& p = options.distortion;
    PreprocessedDepth depth = in_mm(image);
    depth.unit_m = random.chance(0.5) ? 0.001F : 0.0001F;
    find_registered(depth_steps(), "distortion", "step")->make(options)->apply(depth);
    for (int v = 0; v < image.height(); ++v) {
      for (int u = 0; u < image.width(); ++u) {
        const Eigen::Vector3d q =
            depth.intrinsics->back_project(u, v, double{depth.unit_m} * image.at(u, v));
        const double z_m = q.z() - (p.x2_per_m * q.x() * q.x() + p.y2_per_m * q.y() * q.y() +
                                    p.x1 * q.x() + p.y1 * q.y() + p.offset_m);
        const double units = z_m / double{depth.unit_m};
        const bool is_reading = image.at(u, v) != 0 && units >= 0.5 && units <= 65535.0;
        const double nearest = is_reading ? units : 0.0;
        // Floats of 24 bits: half a unit of rounding, and some units where readings are far off.
        EXPECT_NEAR(depth.raw.at(u, v), nearest, 0.51 + 1e-5 * std::abs(nearest))
            << "pixel " << u << " " << v << " of " << image.at(u, v);
      }
    }
  });
}

TEST(Distortion, without_numbers_leaves_the_image_alone_and_asks_for_no_lens) {
  Random random;
  const Image<std::uint16_t> image = random_image(random);
  PreprocessedDepth depth;
  depth.raw = image;
  find_registered(depth_steps(), "distortion", "step")->make({})->apply(depth);
  EXPECT_TRUE(std::ranges::equal(depth.raw.pixels(), image.pixels()));
}

// Brute force from the sentence of method 2, over whole images.
TEST(NearDownsample, keeps_the_smallest_valid_reading_of_every_block_with_its_support) {
  Random random;
  for (int trial = 0; trial < 60; ++trial) {
    const Image<std::uint16_t> image = random_image(random);
    PreprocessOptions options;
    options.downsample = random.integer(2, 11);
    const int n = options.downsample;
    PreprocessedDepth depth = in_mm(image);
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
