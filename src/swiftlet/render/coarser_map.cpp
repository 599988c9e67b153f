// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/render/coarser_map.hpp"

#include <algorithm>

#include "swiftlet/query/known_voxels.hpp"

namespace swiftlet::render {

BlockMap coarser_map(const BlockMap& map, int voxels) {
  MapHeader header = map.header();
  header.voxel_m *= voxels;
  BlockMap out(header);
  const auto place = [voxels](std::int32_t v) { return (v >= 0 ? v : v - voxels + 1) / voxels; };
  for_each_known_voxel(map, [&](const VoxelIndex& v, QuantizedLogOdds voxel, Occupancy state) {
    const VoxelIndex large{place(v.x), place(v.y), place(v.z)};
    QuantizedLogOdds& kept = out.writable(block_of(large)).voxels[offset_in_block(large)];
    const Occupancy before = map.scale().classify(kept);
    if (before == Occupancy::kUnknown || (state == Occupancy::kOccupied && before != state)) {
      kept = voxel;
    } else if (state == before) {
      kept = state == Occupancy::kOccupied ? std::max(kept, voxel) : std::min(kept, voxel);
    }
  });
  return out;
}

}  // namespace swiftlet::render
