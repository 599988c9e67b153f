// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "swiftlet/base/grid_ray.hpp"
#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/query/distance/block_bits.hpp"
#include "swiftlet/query/sweep/moving_part_private.hpp"

namespace swiftlet {

/// Which voxels a scan looks for.
struct WantedVoxels {
  bool is_unknown = true;
  bool is_occupied = true;

  [[nodiscard]] bool is_any() const { return is_unknown || is_occupied; }
  [[nodiscard]] bool has(Occupancy state) const {
    return (state == Occupancy::kOccupied && is_occupied) ||
           (state == Occupancy::kUnknown && is_unknown);
  }
};

/// All voxels of a grid that a box [low, high] touches, of those in `window`; false in `is_any` if
/// there is none.
struct TouchedVoxels {
  VoxelBox box{};
  bool is_any = false;
  bool is_inside = false;  ///< the whole box lies in the window
};
[[nodiscard]] inline TouchedVoxels touched_voxels(const Eigen::Array3d& low,
                                                  const Eigen::Array3d& high,
                                                  const VoxelBox& window) {
  // Clipped as doubles: a box may be larger than indices go.
  const Eigen::Array3d first(window.first.x, window.first.y, window.first.z);
  const Eigen::Array3d last(window.last.x, window.last.y, window.last.z);
  const Eigen::Array3d from = (low - kSlack_voxels).floor(), to = (high + kSlack_voxels).floor();
  TouchedVoxels touched;
  touched.is_any = (to >= first).all() && (from <= last).all();
  touched.is_inside = (from >= first).all() && (to <= last).all();
  const Eigen::Array3i a = from.max(first).cast<int>(), b = to.min(last).cast<int>();
  if (touched.is_any) touched.box = {{a.x(), a.y(), a.z()}, {b.x(), b.y(), b.z()}};
  return touched;
}

/// One look at the voxels of a map, for find_voxel(). [voxels]
struct VoxelQuestion {
  const MapSnapshot& map;
  const OccupancyThresholds& thresholds;
  WantedVoxels wanted;

  /// Voxels below this are of no interest.
  [[nodiscard]] int least() const {
    return wanted.is_unknown ? std::min(thresholds.free_below, thresholds.occupied_from)
                             : thresholds.occupied_from;
  }
  /// Whether a block (null: all voxels unknown) may hold a wanted voxel.
  [[nodiscard]] bool is_worth_a_look(const VoxelBlock* block) const {
    return block == nullptr ? wanted.has(thresholds.classify(kUnknownVoxel))
                            : has_voxel_at_least(*block, least());
  }
};

/// find_voxel() within one block; `block` may be null.
template <class Visit>
bool find_voxel_in_block(const VoxelQuestion& question, const BlockIndex& index,
                         const VoxelBlock* block, const VoxelBox& box, Visit&& visit) {
  const VoxelIndex origin = first_voxel(index);
  const auto low = [](std::int32_t v, std::int32_t from) { return std::max(v - from, 0); };
  const auto high = [](std::int32_t v, std::int32_t from) {
    return std::min(v - from, kBlockEdge - 1);
  };
  const std::uint64_t within =
      voxels_within(low(box.first.x, origin.x), high(box.last.x, origin.x),
                    low(box.first.y, origin.y), high(box.last.y, origin.y));
  const int least = question.least();
  for (int z = low(box.first.z, origin.z); z <= high(box.last.z, origin.z); ++z) {
    std::uint64_t left = block == nullptr ? within : within & voxels_at_least(*block, z, least);
    for (; left != 0; left &= left - 1) {
      const int offset = z * kBlockEdge * kBlockEdge + std::countr_zero(left);
      const Occupancy state = question.thresholds.classify(
          block == nullptr ? kUnknownVoxel : block->voxels[static_cast<std::size_t>(offset)]);
      if (question.wanted.has(state) && visit(voxel_at(index, offset), state)) return true;
    }
  }
  return false;
}

/// Calls visit(VoxelIndex, Occupancy) for the wanted voxels of a box, until it returns true; then
/// returns true. `skip_block(BlockIndex)` may leave out whole blocks that hold a wanted voxel.
/// Blocks without one cost one look. REQUIRES: the box lies in the window.
template <class SkipBlock, class Visit>
bool find_voxel(const VoxelQuestion& question, const VoxelBox& box, SkipBlock&& skip_block,
                Visit&& visit) {
  const BlockIndex first = block_of(box.first), last = block_of(box.last);
  for (BlockIndex b = first; b.z <= last.z; ++b.z) {
    for (b.y = first.y; b.y <= last.y; ++b.y) {
      for (b.x = first.x; b.x <= last.x; ++b.x) {
        const VoxelBlock* block = question.map.find(b);
        if (!question.is_worth_a_look(block) || skip_block(b)) continue;
        if (find_voxel_in_block(question, b, block, box, visit)) return true;
      }
    }
  }
  return false;
}

[[nodiscard]] inline GridCube cube_of(const VoxelIndex& v) {
  return {Eigen::Array3d(v.x, v.y, v.z) + 0.5, 0.5};
}
[[nodiscard]] inline GridCube cube_of(const BlockIndex& b) {
  return {(Eigen::Array3d(b.x, b.y, b.z) + 0.5) * kBlockEdge, 0.5 * kBlockEdge};
}

}  // namespace swiftlet
