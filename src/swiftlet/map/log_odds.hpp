// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <cstdint>

namespace swiftlet {

/// Belief about one voxel: log-odds in steps around 127, saturating. The values are on disk and on
/// the wire.
using QuantizedLogOdds = std::uint8_t;
inline constexpr QuantizedLogOdds kFreeVoxel = 0;  ///< as free as can be told
inline constexpr QuantizedLogOdds kUnknownVoxel =
    127;  ///< L = 0: prior, or evidence that cancels out
inline constexpr QuantizedLogOdds kOccupiedVoxel = 255;  ///< as occupied as can be told

/// Adds whole steps; saturates at both ends.
[[nodiscard]] constexpr QuantizedLogOdds add_steps(QuantizedLogOdds voxel, std::int32_t steps) {
  return static_cast<QuantizedLogOdds>(
      std::clamp<std::int32_t>(voxel + steps, kFreeVoxel, kOccupiedVoxel));
}

/// What a planner makes of a voxel. The values are on the wire.
enum class Occupancy : std::uint8_t { kFree = 0, kUnknown = 1, kOccupied = 2 };

/// Where belief becomes a claim: free below one value, occupied from the other on, unknown between.
struct OccupancyThresholds {
  int free_below = 107;     ///< 20 steps below unknown: one whole free observation (method 6)
  int occupied_from = 180;  ///< the thesis's value

  /// What a voxel claims.
  [[nodiscard]] constexpr Occupancy classify(QuantizedLogOdds voxel) const {
    if (voxel >= occupied_from) return Occupancy::kOccupied;
    return voxel < free_below ? Occupancy::kFree : Occupancy::kUnknown;
  }
  friend constexpr bool operator==(const OccupancyThresholds&,
                                   const OccupancyThresholds&) = default;
};

}  // namespace swiftlet
