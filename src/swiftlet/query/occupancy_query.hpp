// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/map_snapshot.hpp"

namespace swiftlet {

/// Is this point [m, world] free, occupied or unknown? Unknown outside the window. Cost: two array
/// look-ups.
[[nodiscard]] inline Occupancy occupancy_at(const MapSnapshot& map, const Eigen::Vector3d& p_world,
                                            const OccupancyThresholds& thresholds) {
  return thresholds.classify(map.log_odds(voxel_containing(p_world, map.voxel_m())));
}

/// Cells by state, of the blocks that the map holds; everything else is unknown.
struct CellCounts {
  std::size_t free = 0;
  std::size_t unknown = 0;
  std::size_t occupied = 0;

  void add(const VoxelBlock& block, const OccupancyThresholds& thresholds);
};

[[nodiscard]] CellCounts count_cells(const MapSnapshot& map, const OccupancyThresholds& thresholds);

}  // namespace swiftlet
