// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sensor/precision_weighted_model.hpp"

#include <algorithm>

namespace swiftlet {

PrecisionWeightedModel::Evidence PrecisionWeightedModel::evaluate(double z_in_m, double z_out_m,
                                                                  double z_m,
                                                                  double sigma_m) const {
  const double before_m = z_in_m - double{kHidingVoxels} * voxel_m_ - z_m;
  const double left = std::clamp(double{kFadeSigma} - before_m / sigma_m, 0.0, 1.0);
  if (left == 0.0) return {};
  const double middle_m = 0.5 * (z_in_m + z_out_m);
  const double ratio = double{kIndependence} * voxel_m_ * (middle_m - z_m) / (sigma_m * sigma_m);
  const double clear_m = z_out_m + double{kClearVoxels} * voxel_m_ + double{kClearSigma} * sigma_m;
  const double least = z_m > clear_m ? double{kClearGain} * free_log_odds_ : free_log_odds_;
  const double log_odds = std::clamp(ratio, least, double{kMostLogOdds});
  const bool passes = z_m > z_out_m + double{kEndVoxels} * voxel_m_;
  return {log_odds > 0.0 ? left * log_odds : log_odds,
          passes ? -double{kLeastEnds} : 1.0 - double{kLeastEnds}};
}

}  // namespace swiftlet
