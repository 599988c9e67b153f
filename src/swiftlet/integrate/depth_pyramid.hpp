// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/base/image.hpp"
#include "swiftlet/base/worker_team.hpp"

namespace swiftlet {

/// What a square of a depth image holds, in device units.
struct DepthTile {
  std::uint16_t nearest = 0xffff;  ///< smallest reading; 0xffff if there is none
  std::uint16_t farthest = 0;      ///< largest reading; 0 if there is none
  float valid = 0.0F;              ///< share of its pixels that have a reading

  [[nodiscard]] bool has_readings() const { return farthest != 0; }
};

/// What a rectangle of a depth image holds, in device units.
struct DepthRange {
  std::uint16_t nearest = 0xffff;
  std::uint16_t farthest = 0;
  bool is_complete = true;  ///< no pixel without a reading

  [[nodiscard]] bool has_readings() const { return farthest != 0; }
};

/// Pixels [u0, u1] x [v0, v1], both inside.
struct PixelRect {
  int u0, v0, u1, v1;
};

/// Nearest and farthest reading of rectangles of a depth image, in constant time: tiles of 4 x 4
/// pixels, of 8 x 8 and so on.
class DepthPyramid {
 public:
  static constexpr int kTileShift = 2;  ///< tiles of level 0 are 4 pixels wide
  static constexpr int kTile = 1 << kTileShift;

  struct Level {
    int width, height;  // tiles
    std::size_t first;  // in tiles()
  };

  /// Allocates only while images grow.
  void build(const Image<std::uint16_t>& raw, WorkerTeam& team);

  /// The range of a rectangle or of a little more: it is rounded outwards to whole tiles.
  /// REQUIRES: the rectangle lies in the image and is not empty.
  [[nodiscard]] DepthRange range_of(const PixelRect& rect) const;
  /// Of the whole image.
  [[nodiscard]] const DepthTile& whole() const { return tiles_[levels_.back().first]; }
  /// Pixels with a reading.
  [[nodiscard]] std::size_t readings() const { return readings_; }

  [[nodiscard]] const Level& level(int index) const {
    return levels_[static_cast<std::size_t>(index)];
  }
  [[nodiscard]] const DepthTile& tile(const Level& level, int x, int y) const {
    return tiles_[level.first +
                  static_cast<std::size_t>(y) * static_cast<std::size_t>(level.width) +
                  static_cast<std::size_t>(x)];
  }

  [[nodiscard]] std::size_t memory_bytes() const {
    return tiles_.capacity() * sizeof(DepthTile) + levels_.capacity() * sizeof(Level);
  }

 private:
  void lay_out(int width, int height);
  void merge(const Level& from, const Level& to, int tile_shift);

  int width_ = 0, height_ = 0;
  std::size_t readings_ = 0;
  std::vector<Level> levels_;
  std::vector<DepthTile> tiles_;
};

}  // namespace swiftlet
