// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/occupancy_query.hpp"

namespace swiftlet {

void CellCounts::add(const VoxelBlock& block, const OccupancyThresholds& thresholds) {
  for (const QuantizedLogOdds cell : block.cells) {
    switch (thresholds.classify(cell)) {
      case Occupancy::kFree:
        ++free;
        break;
      case Occupancy::kUnknown:
        ++unknown;
        break;
      case Occupancy::kOccupied:
        ++occupied;
        break;
    }
  }
}

CellCounts count_cells(const MapSnapshot& map, const OccupancyThresholds& thresholds) {
  CellCounts counts;
  map.for_each_known_block(
      [&](const BlockIndex&, const VoxelBlock& block) { counts.add(block, thresholds); });
  return counts;
}

}  // namespace swiftlet
