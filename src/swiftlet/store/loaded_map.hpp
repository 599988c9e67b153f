// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <unordered_map>

#include "swiftlet/base/grid_ray.hpp"
#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/voxel_block.hpp"
#include "swiftlet/query/occupancy_query.hpp"

namespace swiftlet {

/// A whole map in memory, for pictures and counts: its blocks wherever they lie, with no window.
struct LoadedMap {
  double voxel_m = 0.2;
  OccupancyThresholds thresholds;
  std::unordered_map<BlockIndex, VoxelBlock, BlockHash> blocks{};
  Eigen::Vector3d start_m = Eigen::Vector3d::Zero();  ///< camera at the first frame [world]

  [[nodiscard]] QuantizedLogOdds log_odds(const VoxelIndex& voxel) const {
    const auto found = blocks.find(block_of(voxel));
    return found == blocks.end() ? kUnknownCell : found->second.cells[offset_in_block(voxel)];
  }
  [[nodiscard]] Occupancy state(const VoxelIndex& voxel) const {
    return thresholds.classify(log_odds(voxel));
  }

  /// Calls visit(VoxelIndex, Occupancy) for every cell that is free or occupied, in no order.
  template <class Visit>
  void for_each_known_cell(Visit&& visit) const {
    for (const auto& [index, block] : blocks) {
      for (int offset = 0; offset < kBlockVoxels; ++offset) {
        const Occupancy cell = thresholds.classify(block.cells[static_cast<std::size_t>(offset)]);
        if (cell != Occupancy::kUnknown) visit(voxel_at(index, offset), cell);
      }
    }
  }
};

/// The box of all cells that are free or occupied; nullopt if there are none.
[[nodiscard]] std::optional<VoxelBox> known_box(const LoadedMap& map);

[[nodiscard]] CellCounts count_cells(const LoadedMap& map);

/// The map in cells of so many along each axis: occupied if one of them is, else free if one is.
[[nodiscard]] LoadedMap coarser(const LoadedMap& map, int cells);

}  // namespace swiftlet
