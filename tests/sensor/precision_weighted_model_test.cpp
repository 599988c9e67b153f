// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sensor/precision_weighted_model.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::Random;

constexpr double kVoxel_m = 0.1;
const double kFreeLogOdds = std::log(0.3 / 0.7);

PrecisionWeightedModel weighted_model() { return {kVoxel_m, kFreeLogOdds}; }

// From two normal densities, not from their logarithm worked out.
TEST(PrecisionWeightedModel,
     is_the_likelihood_of_a_surface_before_the_middle_over_that_of_one_behind) {
  test::for_each_seed(2000, [](Random& random) {
    const double z_in = random.real(0.5, 8.0), z_out = z_in + random.real(0.01, 0.17);
    const double sigma = random.real(0.02, 0.2), middle = 0.5 * (z_in + z_out);
    const double z = z_in + random.real(-0.05, 0.25);
    const auto density = [&](double surface) {
      return std::exp(-0.5 * (z - surface) * (z - surface) / (sigma * sigma));
    };
    const double ratio =
        std::log(density(middle - 0.5 * kVoxel_m) / density(middle + 0.5 * kVoxel_m));
    const double wanted = std::clamp(double{PrecisionWeightedModel::kIndependence} * ratio,
                                     kFreeLogOdds, double{PrecisionWeightedModel::kMostLogOdds});
    EXPECT_NEAR(weighted_model().evaluate(z_in, z_out, z, sigma).log_odds, wanted, 1e-9);
  });
}

TEST(PrecisionWeightedModel, says_nothing_of_what_is_hidden) {
  const double sigma = 0.02, hiding = double{PrecisionWeightedModel::kHidingVoxels} * kVoxel_m;
  const auto log_odds_at = [&](double z_in) {
    return weighted_model().evaluate(z_in, z_in + kVoxel_m, 2.0, sigma).log_odds;
  };
  EXPECT_GT(log_odds_at(2.0), 0.0);
  EXPECT_GT(log_odds_at(2.0 + hiding), 0.0);
  EXPECT_GT(log_odds_at(2.0 + hiding + 0.9 * sigma), 0.0);
  EXPECT_EQ(log_odds_at(2.0 + hiding + 1.01 * sigma), 0.0);
  EXPECT_EQ(weighted_model().evaluate(3.0, 3.1, 2.0, sigma).ends, 0.0);
}

TEST(PrecisionWeightedModel, lets_a_reading_far_behind_speak_twice_as_loud) {
  const double sigma = 0.02;
  const double clear = 2.0 + double{PrecisionWeightedModel::kClearVoxels} * kVoxel_m +
                       double{PrecisionWeightedModel::kClearSigma} * sigma;
  EXPECT_EQ(weighted_model().evaluate(1.9, 2.0, clear - 0.001, sigma).log_odds, kFreeLogOdds);
  EXPECT_EQ(weighted_model().evaluate(1.9, 2.0, clear + 0.001, sigma).log_odds, 2.0 * kFreeLogOdds);
}

// A wall at 2 m, and the empty voxel that ends at it. One reading of a near view against a thousand
// of a blurred one that lie, by their bias, half a voxel too near.
TEST(PrecisionWeightedModel, lets_a_sharp_reading_outvote_blurred_ones) {
  const double sharp = weighted_model().evaluate(1.9, 2.0, 2.0, 0.004).log_odds;
  const double blurred = weighted_model().evaluate(1.9, 2.0, 1.94, 0.4).log_odds;
  EXPECT_LT(sharp, -0.8);
  EXPECT_GT(blurred, 0.0);
  EXPECT_LT(blurred, 0.005);
}

TEST(PrecisionWeightedModel, knows_which_rays_end_in_a_voxel) {
  const auto ends = [](double z) { return weighted_model().evaluate(1.9, 2.0, z, 0.004).ends; };
  const double end = double{PrecisionWeightedModel::kEndVoxels} * kVoxel_m;
  EXPECT_GT(ends(1.95), 0.0);
  EXPECT_GT(ends(2.0), 0.0) << "poses are not that exact";
  EXPECT_GT(ends(2.0 + 0.9 * end), 0.0);
  EXPECT_LT(ends(2.0 + 1.1 * end), 0.0);
  // With a fifth of the rays the voxel is not free.
  EXPECT_NEAR(ends(1.95) + 4.0 * ends(3.0), 0.0, 1e-6);
}

}  // namespace
}  // namespace swiftlet
