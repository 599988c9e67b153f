// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

namespace swiftlet {

/// The readings of squares of a depth image as a kernel gathers them, one word a tile: from the
/// lowest bit
///   16 bits  1 / mean depth, as depth_code() says
///    8 bits  share of the tile's pixels that have one, in kAll-ths
///    8 bits  how narrowly they agree: kNarrowest * sqrt(sigma / deviation), where sigma is that of
///            one reading and the deviation that of where the tile's readings put the surface,
///            their own and among each other
struct DepthMeanTiles {
  const std::int32_t* words;
  std::int32_t stride;  ///< tiles a row
  std::int32_t shift;   ///< a tile is 2^shift pixels wide

  static constexpr float kAll = 255.0F, kNarrowest = 255.0F;

  // Inverse depths are coded as floats of 4 + 12 bits: in them noise is a constant, so what is near
  // is told as finely as it was measured, and no kernel divides by a depth.
  static constexpr int kCodes = 1 << 16;
  static constexpr int kCodeShift = 11;                    ///< of a float's bits
  static constexpr int kFirstCode = (127 - 10) << 12;      ///< 2^-10 / m; the last is 2^6 / m
  static constexpr int kHalfCode = 1 << (kCodeShift - 1);  ///< to round to the nearest
};

/// The code of a depth [m]: of its inverse, within what codes can say.
[[nodiscard]] inline int depth_code(float depth_m) {
  const auto bits = std::bit_cast<std::int32_t>(1.0F / depth_m);
  return std::clamp(((bits + DepthMeanTiles::kHalfCode) >> DepthMeanTiles::kCodeShift) -
                        DepthMeanTiles::kFirstCode,
                    0, DepthMeanTiles::kCodes - 1);
}

/// One row of tiles to be summarised, and where to put it. Every array has room for whole vectors.
struct DepthMeanRow {
  std::int32_t tiles;        ///< with pixels in them
  std::int32_t image_width;  ///< [px]
  std::int32_t pixel_rows;   ///< of the image in this row of tiles
  std::int32_t shift;        ///< a tile is 2^shift pixels wide
  float unit_m, sigma_per_z2;
  float most_scatter_m;  ///< as in DepthMeanPyramid::build()
  std::uint32_t seed;    ///< of this row
  float* count;          ///< readings
  float* mean_m;
  float* variance_m2;
  std::int32_t* words;  ///< as in DepthMeanTiles
};

/// A row of means of the next finer level.
struct FinerMeanRow {
  const float *count, *mean_m, *variance_m2;
  const std::int32_t* words;
};

// On the widest vectors of this machine, the same bits on all of them.

/// Tiles of 2 x 2 from two rows of pixels, of which `row.image_width` are read.
void average_pixels(const std::uint16_t* upper, const std::uint16_t* lower,
                    const DepthMeanRow& row);
/// Tiles from 2 x 2 finer ones.
void merge_means(const FinerMeanRow& upper, const FinerMeanRow& lower, const DepthMeanRow& row);

}  // namespace swiftlet
