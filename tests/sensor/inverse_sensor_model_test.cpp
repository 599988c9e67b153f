// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sensor/inverse_sensor_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/seeds.hpp"
#include "swiftlet/preprocess/depth_step.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet {
namespace {

using test::Random;

// Method 3 and 4 once more, as they are printed with their errata.
double reference_sigma(double z, double f, double B, double s) { return z * z * s / (f * B); }

double reference_log_odds(double z, double z_t, double sigma, double k, double p_min,
                          double p_max) {
  if (z > z_t + 3 * sigma) return 0.0;
  const double p_base = z <= z_t ? p_min : 0.5;
  double p = p_base + (k / (sigma * std::sqrt(2 * std::numbers::pi)) + 0.5 - p_base) *
                          std::exp(-(z - z_t) * (z - z_t) / (2 * sigma * sigma));
  if (p > p_max) p = p_max;
  return std::log(p / (1 - p));
}

StereoSensor d435(const SensorOptions& options = {}, double voxel_m = 0.2, int ratio = 1) {
  const auto intrinsics =
      PinholeIntrinsics::from_field_of_view(848, 480, 91.2 * std::numbers::pi / 180.0);
  return StereoSensor(*intrinsics, options, voxel_m, ratio);
}

TEST(StereoNoise, is_the_erratum_s_square_law) {
  const StereoNoise noise = d435().noise();
  EXPECT_NEAR(noise.focal_px, 415.2, 0.1);  // method 3: 848 px, 91.2 degrees
  for (const double z : {0.3, 1.0, 4.0, 8.0, 16.0}) {
    EXPECT_DOUBLE_EQ(noise.sigma_m(z), reference_sigma(z, noise.focal_px, 0.05, 0.08));
  }
}

TEST(InverseSensorModel, is_the_corrected_equation) {
  Random random;
  for (int trial = 0; trial < 20000; ++trial) {
    InverseSensorModel::Options options;
    options.importance_m = random.real(0.01, 0.5);
    options.p_min = random.real(0.02, 0.48);
    options.p_max = random.real(0.55, 0.99);
    const InverseSensorModel model(options);
    const double z_t = random.real(0.2, 16.0);
    const double sigma = reference_sigma(z_t, 415.2, 0.05, random.real(0.02, 0.3));
    const double z = z_t + sigma * random.real(-12.0, 4.0);
    // The product shortens exp(-32) to nothing: 1e-13 of p, times the slope of the logit at p_min
    // and the amplitude.
    EXPECT_NEAR(
        model.log_odds(z - z_t, sigma),
        reference_log_odds(z, z_t, sigma, options.importance_m, options.p_min, options.p_max), 1e-7)
        << random.repeat();
  }
}

TEST(InverseSensorModel, never_claims_certainty) {
  const InverseSensorModel model({.importance_m = 10.0, .p_min = 0.01, .p_max = 0.97});
  for (double d = -1.0; d < 1.0; d += 0.001) {
    const double logodds = model.log_odds(d, 0.01);
    EXPECT_TRUE(std::isfinite(logodds));
    EXPECT_LE(logodds, std::log(0.97 / 0.03) + 1e-12);
  }
}

// Method 4: "the default k keeps the expected update at the surface clearly positive out to the
// maximum range". Clearly: at least a tenth of what a passing ray takes away.
TEST(InverseSensorModel, lets_no_wall_dissolve_within_the_default_range) {
  const StereoSensor sensor = d435();
  for (double z = 0.2; z <= PreprocessOptions{}.max_range_m; z += 0.1) {
    EXPECT_GT(sensor.model().expected_at_surface(sensor.noise().sigma_m(z)),
              -0.1 * sensor.model().free_log_odds())
        << "at " << z << " m";
  }
}

TEST(InverseSensorModel, lets_distant_walls_dissolve_when_k_is_as_small_as_the_method_warns) {
  SensorOptions options;
  options.model.importance_m = 0.05;
  const StereoSensor sensor = d435(options);
  EXPECT_GT(sensor.model().expected_at_surface(sensor.noise().sigma_m(10.0)), 0.0);
  EXPECT_LT(sensor.model().expected_at_surface(sensor.noise().sigma_m(12.0)), 0.0);
}

// Method 6: one voxel's face at distance z is (density / z)^2 full pixels, of which every n x n
// give one ray.
TEST(StereoSensor, weighs_a_frame_as_one_observation_of_a_covered_voxel_at_any_distance) {
  for (const int n : {1, 2, 4, 8}) {
    const StereoSensor sensor = d435({}, 0.2, n);
    for (const double z : {0.5, 1.0, 3.0, 9.0}) {
      const double pixels_across = sensor.noise().focal_px * 0.2 / z;
      const double rays = pixels_across * pixels_across / (n * n);
      EXPECT_NEAR(rays * sensor.weight(z), 1.0, 1e-12);
    }
  }
}

TEST(StereoSensor, has_the_thesis_s_density_of_86_pixels_within_5_percent) {
  EXPECT_NEAR(1.0 / std::sqrt(d435().weight(1.0)), 86.0, 0.05 * 86.0);
}

TEST(StereoSensor, gives_the_full_reading_to_a_voxel_whose_slice_holds_the_surface) {
  const StereoSensor sensor = d435();
  const double sigma = sensor.noise().sigma_m(1.0);
  const double peak = sensor.model().log_odds(0.0, sigma);
  for (const double offset : {-0.099, -0.05, 0.0, 0.05, 0.099}) {
    EXPECT_EQ(sensor.log_odds(1.0 + offset, 1.0, sigma), peak);
  }
  EXPECT_NEAR(sensor.log_odds(1.0 - 0.2, 1.0, sigma), sensor.model().free_log_odds(), 1e-12);
  EXPECT_EQ(sensor.log_odds(1.0 + 0.1 + 3.1 * sigma, 1.0, sigma), 0.0);
}

}  // namespace
}  // namespace swiftlet
