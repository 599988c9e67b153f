// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "swiftlet/integrate/image/depth_range_pyramid.hpp"
#include "swiftlet/preprocess/neighbour_kernels.hpp"

namespace swiftlet {

/// What the readings of one frame are compared with to find ridges. Depths in device units.
struct RidgeLimits {
  /// A ridge is looked for so far to the sides at least and at most.
  static constexpr float kLeastReach_px = 2.0F, kMostReach_px = 64.0F;

  float half_voxel_px;  // at a depth of one unit
  /// Clearly behind a reading z is what lies farther than z + max(least_behind, this * z^2).
  float least_behind, behind_per_square;

  /// How far to the side half a voxel is, for a reading.
  [[nodiscard]] int reach_px(int z) const {
    const float reach = std::floor(half_voxel_px / static_cast<float>(z)) + 1.0F;
    return static_cast<int>(std::clamp(reach, kLeastReach_px, kMostReach_px));
  }
};

/// A square of an image, whose neighbours may be read up to kMostReach_px away.
struct RidgeTile {
  static constexpr int kEdge = 8;

  const BorderedImage* image;
  int u, v;   ///< its first pixel
  int reach;  ///< how far to the sides to look [px]
};
/// Bit i of row k: pixel (u + i, v + k) lies on a ridge.
using RidgeBits = std::array<std::uint8_t, RidgeTile::kEdge>;

/// Whether the tiles of a level of the pyramid admit a ridge in one of them: something clearly
/// behind its nearest reading, in its row or column within reach.
[[nodiscard]] bool may_have_ridge(const DepthRangeTiles& tiles, std::size_t level, int tile_u,
                                  int tile_v, const RidgeLimits& limits);

/// Finds the readings with something clearly farther, or nothing, to both of their sides or above
/// and below; nothing at all at neither does not count, as beside a near object a stereo camera is
/// blind on one side. On vectors, the same bits on all of them.
[[nodiscard]] RidgeBits find_ridges(const RidgeTile& tile, const RidgeLimits& limits);

}  // namespace swiftlet
