// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/base/image.hpp"

namespace swiftlet {

/// What a rectangle of a depth image holds, in device units.
struct DepthRange {
  std::uint16_t nearest;   ///< smallest reading; 0xffff if there is none
  std::uint16_t farthest;  ///< largest reading; 0 if there is none
  std::uint16_t smallest;  ///< smallest value, missing readings (0) counted too

  [[nodiscard]] bool has_readings() const { return farthest != 0; }
  [[nodiscard]] bool is_complete() const { return smallest != 0; }
};

/// Pixels [u0, u1] x [v0, v1], both inside.
struct PixelRect {
  int u0, v0, u1, v1;
};

/// Nearest and farthest reading of rectangles of a depth image, in constant time: tiles of 4 x 4
/// pixels, of 8 x 8 and so on.
class DepthPyramid {
 public:
  /// Allocates only while images grow.
  void build(const Image<std::uint16_t>& raw);

  /// The range of a rectangle or of a little more: it is rounded outwards to whole tiles.
  /// REQUIRES: the rectangle lies in the image and is not empty.
  [[nodiscard]] DepthRange range_of(const PixelRect& rect) const;
  /// Of the whole image.
  [[nodiscard]] DepthRange range() const { return tiles_[levels_.back().first]; }

  [[nodiscard]] std::size_t memory_bytes() const {
    return tiles_.capacity() * sizeof(DepthRange) + levels_.capacity() * sizeof(Level);
  }

 private:
  static constexpr int kTileShift = 2;  // tiles of level 0 are 4 pixels wide

  struct Level {
    int width, height;  // tiles
    std::size_t first;  // in tiles_
  };
  void build_tiles(const Image<std::uint16_t>& raw);
  void merge_tiles(const Level& from, const Level& to);

  std::vector<Level> levels_;
  std::vector<DepthRange> tiles_;
};

}  // namespace swiftlet
