// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "swiftlet/base/voxel_box.hpp"
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
  [[nodiscard]] constexpr bool is_empty() const {
    return size.x <= 0 || size.y <= 0 || size.z <= 0;
  }
  [[nodiscard]] constexpr std::size_t block_count() const {
    return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) *
           static_cast<std::size_t>(size.z);
  }
  friend constexpr bool operator==(const BlockWindow&, const BlockWindow&) = default;
};

/// All voxels of a window.
[[nodiscard]] constexpr VoxelBox voxel_box(const BlockWindow& window) {
  const auto last = [](std::int32_t first, std::int32_t size) {  // the end may lie behind int32
    return static_cast<std::int32_t>((std::int64_t{first} + size) * kBlockEdge - 1);
  };
  const BlockIndex& b = window.first;
  const BlockIndex& n = window.size;
  return {first_voxel(b), {last(b.x, n.x), last(b.y, n.y), last(b.z, n.z)}};
}

/// The blocks that a box of voxels touches. REQUIRES: first <= last along each axis.
[[nodiscard]] constexpr BlockWindow blocks_around(const VoxelBox& box) {
  const BlockIndex first = block_of(box.first), last = block_of(box.last);
  return {first, {last.x - first.x + 1, last.y - first.y + 1, last.z - first.z + 1}};
}

/// The smallest window that holds both. Extents that do not fit an int32 are cut at its end.
[[nodiscard]] constexpr BlockWindow joined(const BlockWindow& a, const BlockWindow& b) {
  if (a.is_empty()) return b;
  if (b.is_empty()) return a;
  BlockWindow all;
  for (const auto axis : {&BlockIndex::x, &BlockIndex::y, &BlockIndex::z}) {
    const std::int64_t end = std::max(std::int64_t{a.first.*axis} + a.size.*axis,
                                      std::int64_t{b.first.*axis} + b.size.*axis);
    all.first.*axis = std::min(a.first.*axis, b.first.*axis);
    all.size.*axis = static_cast<std::int32_t>(
        std::min<std::int64_t>(end - all.first.*axis, std::numeric_limits<std::int32_t>::max()));
  }
  return all;
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
