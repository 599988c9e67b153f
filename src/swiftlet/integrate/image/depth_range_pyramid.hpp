// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/base/image.hpp"

namespace swiftlet {

/// What the kernels see of a DepthRangePyramid.
struct DepthRangeTiles {
  static constexpr std::size_t kMostLevels = 16;

  const std::int32_t* words;
  int levels;
  std::array<std::int32_t, kMostLevels> first, width;  ///< of each level: in words; tiles in a row
};

/// Nearest and farthest reading of squares of a depth image: tiles of 4 x 4 pixels, of 8 x 8 and so
/// on up to the whole image.
///
/// A tile is one word: its farthest reading, 0 if it has none, in the upper 16 bits; its nearest in
/// the lower ones, rounded down to an even number, because the last bit is kHasGaps.
class DepthRangePyramid {
 public:
  static constexpr int kTileShift = 2;  ///< tiles of level 0 are 4 pixels wide
  static constexpr int kTile = 1 << kTileShift;
  static constexpr std::int32_t kHasGaps = 1;  ///< some pixel has no reading

  /// The word of a tile; nearest and farthest are 0 if it has no reading.
  [[nodiscard]] static std::int32_t word_of(std::uint16_t nearest, std::uint16_t farthest,
                                            bool has_gaps) {
    const std::uint32_t least = nearest == 0 ? 0xffffU : nearest;
    return static_cast<std::int32_t>(std::uint32_t{farthest} << 16U | (least & ~1U) |
                                     (has_gaps ? 1U : 0U));
  }

  /// Allocates only while images grow.
  void build(const Image<std::uint16_t>& raw);

  [[nodiscard]] DepthRangeTiles tiles() const;
  /// Of the whole image; 0 if there is none.
  [[nodiscard]] std::uint16_t farthest() const {
    return static_cast<std::uint16_t>(static_cast<std::uint32_t>(words_.back()) >> 16U);
  }
  /// Pixels with a reading.
  [[nodiscard]] std::size_t readings() const { return readings_; }

  [[nodiscard]] std::size_t memory_bytes() const {
    return words_.capacity() * sizeof(std::int32_t) + levels_.capacity() * sizeof(Level);
  }

 private:
  struct Level {
    std::size_t width, height, first;
  };
  void lay_out(int width, int height);
  void merge(const Level& from, const Level& to);

  int width_ = 0, height_ = 0;
  std::size_t readings_ = 0;
  std::vector<Level> levels_;
  std::vector<std::int32_t> words_;
};

}  // namespace swiftlet
