// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "swiftlet/base/grid_ray.hpp"
#include "swiftlet/base/voxel_index.hpp"

namespace swiftlet {

/// A box of blocks: [first, first + size) along each axis.
struct BlockWindow {
  BlockIndex first;
  BlockIndex size;  ///< extents in blocks, not a position

  [[nodiscard]] constexpr bool contains(const BlockIndex& b) const {
    const auto inside = [](std::int32_t v, std::int32_t from, std::int32_t n) {
      return static_cast<std::uint32_t>(v - from) < static_cast<std::uint32_t>(n);
    };
    return inside(b.x, first.x, size.x) && inside(b.y, first.y, size.y) &&
           inside(b.z, first.z, size.z);
  }
  [[nodiscard]] constexpr BlockIndex end() const {
    return {first.x + size.x, first.y + size.y, first.z + size.z};
  }
  [[nodiscard]] constexpr std::size_t block_count() const {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
  }
  friend constexpr bool operator==(const BlockWindow&, const BlockWindow&) = default;
};

/// All cells of a window.
[[nodiscard]] constexpr VoxelBox voxel_box(const BlockWindow& window) {
  const VoxelIndex behind = first_voxel(window.end());
  return {first_voxel(window.first), {behind.x - 1, behind.y - 1, behind.z - 1}};
}

/// Calls visit(BlockIndex) for every block of a window, x fastest.
template <class Visit>
void for_each_block(const BlockWindow& window, Visit&& visit) {
  const BlockIndex end = window.end();
  for (BlockIndex b = window.first; b.z < end.z; ++b.z) {
    for (b.y = window.first.y; b.y < end.y; ++b.y) {
      for (b.x = window.first.x; b.x < end.x; ++b.x) visit(b);
    }
  }
}

/// Calls visit(BlockIndex) for every block of `window` that `other` does not hold.
/// REQUIRES: both have the same size. Cost: O(blocks visited), so a shift costs the slab and not
/// the window.
template <class Visit>
void for_each_block_outside(const BlockWindow& window, const BlockWindow& other, Visit&& visit) {
  // Peel off one slab per axis: what lies outside `other` along x, then of the rest along y, then
  // along z.
  BlockWindow rest = window;
  const auto peel = [&](std::int32_t BlockIndex::*axis) {
    const std::int32_t shift = other.first.*axis - rest.first.*axis;
    const std::int32_t thickness = std::min(std::abs(shift), rest.size.*axis);
    BlockWindow slab = rest;
    slab.size.*axis = thickness;
    if (shift < 0) slab.first.*axis += rest.size.*axis - thickness;
    for_each_block(slab, visit);
    rest.size.*axis -= thickness;
    if (shift > 0) rest.first.*axis += thickness;
  };
  peel(&BlockIndex::x);
  peel(&BlockIndex::y);
  peel(&BlockIndex::z);
}

}  // namespace swiftlet
