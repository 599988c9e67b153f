// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/loaded_map.hpp"

namespace swiftlet::app {

std::optional<VoxelBox> known_box(const LoadedMap& map) {
  std::optional<VoxelBox> box;
  map.for_each_known_cell([&](const VoxelIndex& v, Occupancy) {
    if (!box) box = VoxelBox{v, v};
    box->include(v);
  });
  return box;
}

CellCounts count_cells(const LoadedMap& map) {
  CellCounts counts;
  for (const auto& [index, block] : map.blocks) counts.add(block, map.thresholds);
  return counts;
}

}  // namespace swiftlet::app
