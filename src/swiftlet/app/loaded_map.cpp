// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/loaded_map.hpp"

#include <algorithm>

namespace swiftlet::app {

std::optional<VoxelBox> known_box(const LoadedMap& map) {
  std::optional<VoxelBox> box;
  map.for_each_known_cell([&](const VoxelIndex& v, Occupancy) {
    if (!box) box = VoxelBox{v, v};
    box->first = {std::min(box->first.x, v.x), std::min(box->first.y, v.y),
                  std::min(box->first.z, v.z)};
    box->last = {std::max(box->last.x, v.x), std::max(box->last.y, v.y),
                 std::max(box->last.z, v.z)};
  });
  return box;
}

CellCounts count_cells(const LoadedMap& map) {
  CellCounts counts;
  for (const auto& [index, block] : map.blocks) counts.add(block, map.thresholds);
  return counts;
}

}  // namespace swiftlet::app
