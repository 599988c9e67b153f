// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>

#include "swiftlet/map/occupancy_map.hpp"

namespace swiftlet {

/// Voxels by state.
struct VoxelCounts {
  std::size_t free = 0;      ///< voxels below the lower threshold
  std::size_t unknown = 0;   ///< voxels between the two
  std::size_t occupied = 0;  ///< voxels from the upper threshold on

  /// One voxel more.
  void add(Occupancy state) {
    ++(state == Occupancy::kFree ? free : state == Occupancy::kUnknown ? unknown : occupied);
  }
  /// The voxels of a block more.
  void add(const VoxelBlock& block, const OccupancyThresholds& thresholds);
  friend bool operator==(const VoxelCounts&, const VoxelCounts&) = default;
};

/// Voxels of the blocks that the map holds; everything else is unknown and not counted.
/// By thresholds of the caller's, or those of the map. Cost: O(blocks).
template <OccupancyMap Map>
[[nodiscard]] VoxelCounts count_voxels(const Map& map, const OccupancyThresholds& thresholds) {
  VoxelCounts counts;
  map.for_each_known_block(
      [&](const BlockIndex&, const VoxelBlock& block) { counts.add(block, thresholds); });
  return counts;
}
/// By the map's own thresholds.
template <OccupancyMap Map>
[[nodiscard]] VoxelCounts count_voxels(const Map& map) {
  return count_voxels(map, OccupancyThresholds(map.scale().thresholds));
}

}  // namespace swiftlet
