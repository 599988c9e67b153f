// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/cell_counts.hpp"

namespace swiftlet {

void CellCounts::add(const VoxelBlock& block, const OccupancyThresholds& thresholds) {
  for (const QuantizedLogOdds cell : block.cells) add(thresholds.classify(cell));
}

}  // namespace swiftlet
