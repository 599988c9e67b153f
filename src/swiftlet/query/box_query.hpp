// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/voxel_box.hpp"
#include "swiftlet/query/voxel_counts.hpp"

namespace swiftlet {

/// Calls visit(const VoxelBlock*, VoxelBox part) for every block that a box of voxels touches, x
/// fastest: `part` is what of the block lies in the box, the block null where nothing is known.
/// REQUIRES: box.first <= box.last along each axis.
template <OccupancyMap Map, class Visit>
void for_each_block_of_box(const Map& map, const VoxelBox& box, Visit&& visit) {
  for_each_block(blocks_around(box), [&](const BlockIndex& index) {
    const VoxelIndex low = first_voxel(index);
    const auto last = [](std::int32_t from, std::int32_t to) {
      return std::min(from + (kBlockEdge - 1), to);
    };
    visit(map.find(index),
          VoxelBox{{std::max(low.x, box.first.x), std::max(low.y, box.first.y),
                    std::max(low.z, box.first.z)},
                   {last(low.x, box.last.x), last(low.y, box.last.y), last(low.z, box.last.z)}});
  });
}

/// The voxels of a box by state, by the map's own thresholds; what lies outside the map is unknown.
/// REQUIRES: box.first <= box.last along each axis. Cost: O(voxels). Does not allocate.
template <OccupancyMap Map>
[[nodiscard]] VoxelCounts count_voxels(const Map& map, const VoxelBox& box) {
  const OccupancyThresholds thresholds = map.scale().thresholds;
  VoxelCounts counts;
  for_each_block_of_box(map, box, [&](const VoxelBlock* block, const VoxelBox& part) {
    if (block == nullptr) {
      counts.unknown += part.voxel_count();
      return;
    }
    for (VoxelIndex v = part.first; v.z <= part.last.z; ++v.z) {
      for (v.y = part.first.y; v.y <= part.last.y; ++v.y) {
        for (v.x = part.first.x; v.x <= part.last.x; ++v.x)
          counts.add(thresholds.classify(block->voxels[offset_in_block(v)]));
      }
    }
  });
  return counts;
}

/// The voxels of a box as a dense array in the caller's buffer, each what `read` makes of its byte.
/// Shape (nx, ny, nz), x fastest, then y, then z, from box.first to box.last; what lies outside the
/// map is read(kUnknownVoxel). REQUIRES: box.first <= box.last along each axis and room in `out`
/// for box.voxel_count(); what is behind stays as it is. Cost: O(voxels). Does not allocate.
template <OccupancyMap Map, class T, class Read>
void copy_box(const Map& map, const VoxelBox& box, std::span<T> out, Read&& read) {
  SWIFTLET_REQUIRE(out.size() >= box.voxel_count(), "the buffer has room for the box");
  const auto along = [](std::int32_t from, std::int32_t to) {
    return static_cast<std::size_t>(std::int64_t{to} - from);
  };
  const std::size_t nx = along(box.first.x, box.last.x) + 1;
  const std::size_t ny = along(box.first.y, box.last.y) + 1;
  for_each_block_of_box(map, box, [&](const VoxelBlock* block, const VoxelBox& part) {
    const std::size_t length = along(part.first.x, part.last.x) + 1;
    for (VoxelIndex v = part.first; v.z <= part.last.z; ++v.z) {
      for (v.y = part.first.y; v.y <= part.last.y; ++v.y) {
        const std::size_t row = along(box.first.z, v.z) * ny + along(box.first.y, v.y);
        T* const to = out.data() + row * nx + along(box.first.x, v.x);
        if (block == nullptr) {
          std::fill_n(to, length, read(kUnknownVoxel));
        } else {
          std::transform(&block->voxels[offset_in_block(v)],
                         &block->voxels[offset_in_block(v)] + length, to, read);
        }
      }
    }
  });
}

/// The bytes themselves.
template <OccupancyMap Map>
void copy_box(const Map& map, const VoxelBox& box, std::span<QuantizedLogOdds> out) {
  copy_box(map, box, out, [](QuantizedLogOdds voxel) { return voxel; });
}
/// Free, unknown or occupied, by the map's own thresholds.
template <OccupancyMap Map>
void copy_box(const Map& map, const VoxelBox& box, std::span<Occupancy> out) {
  const OccupancyThresholds thresholds = map.scale().thresholds;
  copy_box(map, box, out, [&](QuantizedLogOdds voxel) { return thresholds.classify(voxel); });
}
/// Probabilities of matter, 0 to 1.
template <OccupancyMap Map>
void copy_box(const Map& map, const VoxelBox& box, std::span<float> out) {
  std::array<float, std::numeric_limits<QuantizedLogOdds>::max() + 1> probability{};
  const LogOddsScale scale = map.scale();
  for (std::size_t i = 0; i < probability.size(); ++i)
    probability[i] = static_cast<float>(scale.probability(static_cast<QuantizedLogOdds>(i)));
  copy_box(map, box, out, [&](QuantizedLogOdds voxel) { return probability[voxel]; });
}

}  // namespace swiftlet
