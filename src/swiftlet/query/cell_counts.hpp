// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>

#include "swiftlet/map/occupancy_map.hpp"

namespace swiftlet {

/// Cells by state.
struct CellCounts {
  std::size_t free = 0;      ///< cells below the lower threshold
  std::size_t unknown = 0;   ///< cells between the two
  std::size_t occupied = 0;  ///< cells from the upper threshold on

  /// One cell more.
  void add(Occupancy state) {
    ++(state == Occupancy::kFree ? free : state == Occupancy::kUnknown ? unknown : occupied);
  }
  /// The cells of a block more.
  void add(const VoxelBlock& block, const OccupancyThresholds& thresholds);
  friend bool operator==(const CellCounts&, const CellCounts&) = default;
};

/// Cells of the blocks that the map holds; everything else is unknown and not counted.
/// By thresholds of the caller's, or those of the map. Cost: O(blocks).
template <OccupancyMap Map>
[[nodiscard]] CellCounts count_cells(const Map& map, const OccupancyThresholds& thresholds) {
  CellCounts counts;
  map.for_each_known_block(
      [&](const BlockIndex&, const VoxelBlock& block) { counts.add(block, thresholds); });
  return counts;
}
/// By the map's own thresholds.
template <OccupancyMap Map>
[[nodiscard]] CellCounts count_cells(const Map& map) {
  return count_cells(map, OccupancyThresholds(map.scale().thresholds));
}

}  // namespace swiftlet
