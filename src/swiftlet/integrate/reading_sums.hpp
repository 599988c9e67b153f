// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace swiftlet {

/// Neighbouring pixels of one image row.
struct PixelRun {
  const std::uint16_t* readings;
  std::int32_t count;
  float u, v;  // of the first
};

/// What the readings of a cell's image are compared with. All lengths in metres.
struct ReadingQuery {
  // The cell: depth of its centre, half its edge.
  float z;
  float half_voxel;
  // Rays: direction = origin + u per_u + v per_v, each axis times `sign` of the cell's near face.
  std::array<float, 3> near, origin, per_u, per_v;
  // Readings: depth of one device unit, sigma = sigma_per_z2 z^2, 3 sigma of reach.
  float unit;
  float three_sigma_per_z2;
  // The model's table (EvidenceTable): log_odds[row * row_length + column].
  const float* columns_per_m;  // of a row
  const std::int32_t* log_odds;
  int row_shift;  // row = raw >> row_shift
  std::int32_t row_length;
  float zero_column, last_column;
  // What needs no table: clearly in front; at the reading, while that is nearer than sure_z.
  float clear_per_reach;  // "clearly" is this much times 3 sigma
  std::int32_t free, at_reading;
  float sure_z;
  const std::uint16_t* image_end;  // nothing may be read from here on
};

/// The sum of the table's values over runs of pixels: of those with a reading whose ray reaches the
/// cell. Runs on the widest vectors of this machine; the same bits on all of them, because every
/// lane does the same operations in the same order and sums are integers.
[[nodiscard]] std::int32_t sum_readings(std::span<const PixelRun> runs, const ReadingQuery& query);

}  // namespace swiftlet
