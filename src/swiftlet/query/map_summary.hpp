// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>

#include "swiftlet/base/voxel_box.hpp"
#include "swiftlet/query/voxel_counts.hpp"

namespace swiftlet {

/// How much a map knows, and where.
struct MapSummary {
  VoxelCounts voxels;              ///< of the blocks there are
  std::optional<VoxelBox> bounds;  ///< of the free and occupied voxels; none: there are none

  /// The voxels of a block more.
  void add(const BlockIndex& index, const VoxelBlock& block, const OccupancyThresholds& thresholds);
};

/// By the map's own thresholds. Cost: O(blocks).
template <OccupancyMap Map>
[[nodiscard]] MapSummary summarize(const Map& map) {
  const OccupancyThresholds thresholds = map.scale().thresholds;
  MapSummary summary;
  map.for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
    summary.add(index, block, thresholds);
  });
  return summary;
}

}  // namespace swiftlet
