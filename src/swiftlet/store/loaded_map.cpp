// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/loaded_map.hpp"

#include <algorithm>

namespace swiftlet {

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

LoadedMap coarser(const LoadedMap& map, int cells) {
  LoadedMap out{map.voxel_m * cells, map.thresholds, {}, map.start_m};
  const auto place = [cells](std::int32_t v) { return (v >= 0 ? v : v - cells + 1) / cells; };
  map.for_each_known_cell([&](const VoxelIndex& v, Occupancy state) {
    const VoxelIndex large{place(v.x), place(v.y), place(v.z)};
    const auto [block, is_new] = out.blocks.try_emplace(block_of(large));
    if (is_new) block->second.clear();
    QuantizedLogOdds& kept = block->second.cells[offset_in_block(large)];
    const QuantizedLogOdds cell = map.log_odds(v);
    const Occupancy before = map.thresholds.classify(kept);
    if (before == Occupancy::kUnknown || (state == Occupancy::kOccupied && before != state)) {
      kept = cell;
    } else if (state == before) {
      kept = state == Occupancy::kOccupied ? std::max(kept, cell) : std::min(kept, cell);
    }
  });
  return out;
}

}  // namespace swiftlet
