// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <utility>

#include "swiftlet/map/occupancy_map.hpp"

namespace swiftlet {

/// Calls visit(VoxelIndex, QuantizedLogOdds, Occupancy) for every voxel of a block that is free or
/// occupied.
template <class Visit>
void for_each_known_voxel(const BlockIndex& index, const VoxelBlock& block,
                          const OccupancyThresholds& thresholds, Visit&& visit) {
  for (int offset = 0; offset < kBlockVoxels; ++offset) {
    const QuantizedLogOdds voxel = block.voxels[static_cast<std::size_t>(offset)];
    const Occupancy state = thresholds.classify(voxel);
    if (state != Occupancy::kUnknown) visit(voxel_at(index, offset), voxel, state);
  }
}

/// The same of a whole map, by its own thresholds; in the order of its blocks. Cost: O(blocks).
template <OccupancyMap Map, class Visit>
void for_each_known_voxel(const Map& map, Visit&& visit) {
  const OccupancyThresholds thresholds = map.scale().thresholds;
  map.for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
    for_each_known_voxel(index, block, thresholds, visit);
  });
}

}  // namespace swiftlet
