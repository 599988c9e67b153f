// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/render/coarser_map.hpp"

#include <algorithm>

#include "swiftlet/query/known_voxels.hpp"

namespace swiftlet::render {

BlockMap coarser_map(const BlockMap& map, int cells) {
  MapHeader header = map.header();
  header.voxel_m *= cells;
  BlockMap out(header);
  const auto place = [cells](std::int32_t v) { return (v >= 0 ? v : v - cells + 1) / cells; };
  for_each_known_voxel(map, [&](const VoxelIndex& v, QuantizedLogOdds cell, Occupancy state) {
    const VoxelIndex large{place(v.x), place(v.y), place(v.z)};
    QuantizedLogOdds& kept = out.writable(block_of(large)).cells[offset_in_block(large)];
    const Occupancy before = map.scale().classify(kept);
    if (before == Occupancy::kUnknown || (state == Occupancy::kOccupied && before != state)) {
      kept = cell;
    } else if (state == before) {
      kept = state == Occupancy::kOccupied ? std::max(kept, cell) : std::min(kept, cell);
    }
  });
  return out;
}

}  // namespace swiftlet::render
