// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// One bit a voxel of a block: bit x of byte y + 8 z.
struct alignas(64) ObstacleBits {
  std::array<std::uint8_t, kBlockVoxels / 8> rows;
  friend bool operator==(const ObstacleBits&, const ObstacleBits&) = default;
};

/// What a distance field keeps of a block.
struct ObstacleClasses {
  ObstacleBits occupied, not_free;
  friend bool operator==(const ObstacleClasses&, const ObstacleClasses&) = default;
};

/// Bits by word.
struct TodoBits {
  /// REQUIRES: 0 <= first <= last.
  static void set(std::uint64_t* words, std::ptrdiff_t first, std::ptrdiff_t last) {
    for (std::ptrdiff_t w = first >> 6; w <= last >> 6; ++w) {
      const std::ptrdiff_t low = std::max<std::ptrdiff_t>(first - w * 64, 0);
      const std::ptrdiff_t high = std::min<std::ptrdiff_t>(last - w * 64, 63);
      words[w] |= (~std::uint64_t{0} >> (63 - high)) & (~std::uint64_t{0} << low);
    }
  }
};

/// The arrays of one distance layer, as the passes see them. Values are in voxels, squared but for
/// `along_z`; `cap` and larger mean out of reach. Rows, slices and vectors are counted by position,
/// see DistanceGrid.
struct DistanceArrays {
  using Index = std::ptrdiff_t;
  Index vectors, box_vectors, rows, slices;
  Index row, slice, padded_slice;  ///< how far apart [voxels]
  const std::int32_t* row_at;
  const std::int32_t* slice_at;
  const std::int32_t* vector_at;

  int reach;                       ///< the least whole number whose square is cap or more
  std::uint16_t cap;               ///< the least square that is out of reach
  const std::uint8_t* reach_from;  ///< by square: how far away it may still be the nearest
  bool is_outside_obstacle;
  std::uint16_t flip;           ///< 0xffff: obstacles are the bits that are 0
  const ObstacleBits* bits;     ///< by place of blocks
  std::uint8_t* along_z;        ///< distance to the nearest obstacle of the same column
  std::uint16_t* within_slice;  ///< ... of the same slice: along_z under minimum over y
  std::uint16_t* everywhere;    ///< ... of all: within_slice under minimum over x
  std::uint64_t* columns;       ///< what to do: bit y of row_words words for each vector
  std::uint64_t* rows_todo;     ///< bit y of row_words words for each slice and vector
  std::uint64_t* lines_todo;    ///< bit x-vector of line_words words for each slice and row
  std::uint8_t* has_lines;      ///< by slice: whether any bit of its lines is set
  Index row_words, line_words;

  /// Every row that a value of this column and slice may decide.
  void mark_rows(Index z, Index vector, Index y, Index span) const {
    const Index first = std::max<Index>(y - span, 0), last = std::min(y + span, rows - 1);
    if (first > last) return;
    TodoBits::set(rows_todo + (z * box_vectors + vector) * row_words, first, last);
  }
  /// Every vector of a line that values at x_first to x_last may decide; they may lie outside.
  void mark_line(Index z, Index y, Index x_first, Index x_last) const {
    const Index first = std::max<Index>(x_first, 0) >> 4;
    const Index last = std::min(x_last >> 4, box_vectors - 1);
    if (first > last) return;
    has_lines[z] = 1;
    TodoBits::set(lines_todo + (z * rows + y) * line_words, first, last);
  }
};

// The same bits on all vectors: whole numbers only.

/// Which voxels of a block are occupied, and which are not free.
[[nodiscard]] ObstacleClasses classes_of(const VoxelBlock& block,
                                         const OccupancyThresholds& thresholds);

/// Works off the columns of one vector; marks rows. `scratch`: 16 bytes a slice.
void pass_columns(const DistanceArrays& arrays, std::ptrdiff_t vector, std::uint8_t* scratch);

/// Works off the rows of one slice, marks lines of it, and works these off.
/// `scratch`: 16 x box_vectors + 2 x reach + 32 words.
void pass_slice(const DistanceArrays& arrays, std::ptrdiff_t z, std::uint16_t* scratch);

}  // namespace swiftlet
