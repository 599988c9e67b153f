// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>

namespace swiftlet {

/// The readings of squares of a depth image as a kernel gathers them, one word and one float a
/// tile.
struct ReadingTiles {
  /// Mean reading [device units] in the low 16 bits; in the high ones the share of the tile's
  /// pixels that have one, in kAll-ths.
  const std::int32_t* mean_and_share;
  /// 1 / deviation [1/m] of where the tile's readings put the surface: of one reading, and of the
  /// readings among each other.
  const float* per_deviation;
  std::int32_t stride;  ///< tiles a row
  std::int32_t shift;   ///< a tile is 2^shift pixels wide

  static constexpr float kAll = 32767.0F;
};

/// One row of tiles to be summarised, and where to put it. Every array has room for whole vectors.
struct SummaryRow {
  std::int32_t tiles;        ///< with pixels in them
  std::int32_t image_width;  ///< [px]
  std::int32_t pixel_rows;   ///< of the image in this row of tiles
  std::int32_t shift;        ///< a tile is 2^shift pixels wide
  float unit_m, sigma_per_z2;
  float most_scatter_m;  ///< as in ReadingSummaries::build()
  std::uint32_t seed;    ///< of this row
  float* count;          ///< readings
  float* mean_m;
  float* variance_m2;
  std::int32_t* mean_and_share;  ///< as in ReadingTiles
  float* per_deviation;          ///< as in ReadingTiles
};

/// A row of summaries of the next finer level.
struct FinerRow {
  const float *count, *mean_m, *variance_m2;
  const std::int32_t* mean_and_share;
  const float* per_deviation;
};

// On the widest vectors of this machine, the same bits on all of them.

/// Tiles of 2 x 2 from two rows of pixels.
void summarise_pixels(const std::uint16_t* upper, const std::uint16_t* lower,
                      const SummaryRow& row);
/// Tiles from 2 x 2 finer ones.
void merge_summaries(const FinerRow& upper, const FinerRow& lower, const SummaryRow& row);

}  // namespace swiftlet
