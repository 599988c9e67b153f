// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sensor/inverse_sensor_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {
namespace {

const double kSqrtTwoPi = std::sqrt(2.0 * std::numbers::pi);

/// Midpoint rule over +-6 sigma of a reading's scatter; the integrand jumps at 0, a voxel boundary
/// here.
constexpr int kScatterVoxels = 600;
constexpr double kScatterLimit = 6.0;
constexpr double kScatterStep = 2.0 * kScatterLimit / kScatterVoxels;

double logit(double p) { return std::log(p / (1.0 - p)); }

}  // namespace

InverseSensorModel::InverseSensorModel(const Options& options)
    : options_(options), free_log_odds_(logit(options.p_min)) {
  SWIFTLET_REQUIRE(options.importance_m > 0.0, "k must be positive");
  SWIFTLET_REQUIRE(options.p_min > 0.0 && options.p_min < 0.5, "p_min must lie between 0 and 0.5");
  SWIFTLET_REQUIRE(options.p_max > 0.5 && options.p_max < 1.0, "p_max must lie between 0.5 and 1");
}

double InverseSensorModel::log_odds(double d_m, double sigma_m) const {
  const double d_sigma = d_m / sigma_m;
  if (d_sigma < -kClearlyInFrontSigma) return free_log_odds_;
  if (d_sigma > kBandSigma) return 0.0;
  const double p_base = d_m <= 0.0 ? options_.p_min : 0.5;
  const double amplitude = options_.importance_m / (sigma_m * kSqrtTwoPi) + 0.5 - p_base;
  const double p = p_base + amplitude * std::exp(-0.5 * d_sigma * d_sigma);
  return logit(std::min(p, options_.p_max));
}

double InverseSensorModel::expected_at_surface(double sigma_m) const {
  double sum = 0.0;
  for (int i = 0; i < kScatterVoxels; ++i) {
    const double scatter = -kScatterLimit + (i + 0.5) * kScatterStep;
    const double density = std::exp(-0.5 * scatter * scatter) / kSqrtTwoPi;
    sum += density * kScatterStep * log_odds(-scatter * sigma_m, sigma_m);
  }
  return sum;
}

}  // namespace swiftlet
