// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cmath>

#include "swiftlet/map/log_odds.hpp"

namespace swiftlet {

/// How the voxels of one map are read: what a step is worth, and where belief becomes a claim.
struct LogOddsScale {
  OccupancyThresholds thresholds{};  ///< where belief becomes a claim
  double logodds_per_step = 0.04;    ///< natural logarithm of the odds, for one step of a voxel

  /// What a voxel claims.
  [[nodiscard]] constexpr Occupancy classify(QuantizedLogOdds voxel) const {
    return thresholds.classify(voxel);
  }
  /// Probability that there is matter in the voxel, 0 to 1; 0.5 where nothing is known.
  [[nodiscard]] double probability(QuantizedLogOdds voxel) const {
    return 1.0 / (1.0 + std::exp((kUnknownVoxel - voxel) * logodds_per_step));
  }
  friend constexpr bool operator==(const LogOddsScale&, const LogOddsScale&) = default;
};

}  // namespace swiftlet
