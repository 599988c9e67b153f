// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/distance/distance_kernels.hpp"

#include <algorithm>
#include <bit>
#include <cstring>

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/query/distance/distance_kernels.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Bytes = hn::CappedTag<std::uint8_t, 16>;
using Words = hn::CappedTag<std::uint16_t, 16>;
using NarrowWords = hn::Rebind<std::uint8_t, Words>;
using ByteLanes = hn::Vec<Bytes>;
using WordLanes = hn::Vec<Words>;
constexpr auto kByteLanes = static_cast<int>(hn::MaxLanes(Bytes()));
constexpr auto kWordLanes = static_cast<int>(hn::MaxLanes(Words()));
constexpr std::ptrdiff_t kVector = 16;

ObstacleClasses classes(const VoxelBlock& block, const OccupancyThresholds& thresholds) {
  // The widest vectors there are: each bit is a byte of its own.
  using Voxels = hn::CappedTag<std::uint8_t, 64>;
  constexpr Voxels d;
  constexpr auto kVoxels = static_cast<std::size_t>(hn::MaxLanes(Voxels()));
  const auto from = [](int least) { return static_cast<std::uint8_t>(std::clamp(least, 0, 255)); };
  const auto occupied_from = hn::Set(d, from(thresholds.occupied_from));
  const auto not_free_from = hn::Set(d, from(thresholds.free_below));
  const auto never = hn::FirstN(d, 0);
  ObstacleClasses classes{};
  for (std::size_t i = 0; i < kBlockVoxels; i += kVoxels) {
    const auto voxels = hn::LoadU(d, block.voxels.data() + i);
    const auto is_at_least = [&](auto least) { return hn::Eq(hn::Max(voxels, least), voxels); };
    const auto occupied = thresholds.occupied_from > 255 ? never : is_at_least(occupied_from);
    const auto known = thresholds.free_below > 255 ? never : is_at_least(not_free_from);
    const auto not_free = hn::Or(occupied, known);
    if constexpr (kVoxels >= 8) {
      hn::StoreMaskBits(d, occupied, classes.occupied.rows.data() + i / 8);
      hn::StoreMaskBits(d, not_free, classes.not_free.rows.data() + i / 8);
    } else {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(d, occupied, bits);
      classes.occupied.rows[i / 8] |= static_cast<std::uint8_t>(bits[0] << (i % 8));
      hn::StoreMaskBits(d, not_free, bits);
      classes.not_free.rows[i / 8] |= static_cast<std::uint8_t>(bits[0] << (i % 8));
    }
  }
  return classes;
}

/// The bits of up to 16 lanes, from lane `part` on.
HWY_INLINE hn::Mask<Bytes> obstacles_at(std::uint32_t bits, int part) {
  const std::uint64_t word = bits >> part;
  std::uint8_t bytes[8];
  std::memcpy(bytes, &word, sizeof(bytes));
  return hn::LoadMaskBits(Bytes(), bytes);
}

/// The distance along z of one column of 16 lanes: down, then up; marks the rows of what changed.
HWY_INLINE void column(const DistanceArrays& a, std::ptrdiff_t vector, std::ptrdiff_t y,
                       std::uint8_t* scratch) {
  constexpr Bytes d;
  const ByteLanes one = hn::Set(d, 1), most = hn::Set(d, static_cast<std::uint8_t>(a.reach));
  const ByteLanes outside = a.is_outside_obstacle ? hn::Zero(d) : most;
  const std::ptrdiff_t row = a.row_at[y], y_place = row / a.row;
  const std::ptrdiff_t x = a.vector_at[vector] * kVector;
  const std::ptrdiff_t block_row = 2 * a.vectors, block_slice = block_row * (a.rows / kBlockEdge);
  const ObstacleBits* const blocks =
      a.bits + y_place / kBlockEdge * block_row + 2 * std::ptrdiff_t{a.vector_at[vector]};
  const auto bits_of = [&](std::ptrdiff_t z_place) {
    const ObstacleBits* pair = blocks + z_place / kBlockEdge * block_slice;
    const auto byte =
        static_cast<std::size_t>(z_place % kBlockEdge * kBlockEdge + y_place % kBlockEdge);
    return (std::uint32_t{pair[0].rows[byte]} | (std::uint32_t{pair[1].rows[byte]} << 8U)) ^ a.flip;
  };
  for (int part = 0; part < kVector; part += kByteLanes) {
    ByteLanes down = outside;
    for (std::ptrdiff_t z = 0; z < a.slices; ++z) {
      down = hn::Min(hn::SaturatedAdd(down, one), most);
      down = hn::IfThenZeroElse(obstacles_at(bits_of(a.slice_at[z]), part), down);
      hn::StoreU(down, d, scratch + z * kVector + part);
    }
    ByteLanes up = outside;
    std::uint8_t* const values = a.along_z + row + x + part;
    for (std::ptrdiff_t z = a.slices - 1; z >= 0; --z) {
      up = hn::Min(hn::SaturatedAdd(up, one), hn::LoadU(d, scratch + z * kVector + part));
      std::uint8_t* const value = values + a.slice_at[z] * a.padded_slice;
      const ByteLanes old = hn::LoadU(d, value);
      const auto is_same = hn::Eq(old, up);
      if (hn::AllTrue(d, is_same)) continue;
      hn::StoreU(up, d, value);
      const ByteLanes changed = hn::IfThenElse(is_same, most, hn::Min(old, up));
      const int least = hn::GetLane(hn::MinOfLanes(d, changed));
      a.mark_rows(z, vector, y, a.reach_from[std::min<int>(least * least, a.cap)]);
    }
  }
}

void columns(const DistanceArrays& a, std::ptrdiff_t vector, std::uint8_t* scratch) {
  std::uint64_t* const todo = a.columns + vector * a.row_words;
  for (std::ptrdiff_t w = 0; w < a.row_words; ++w) {
    for (std::uint64_t rest = todo[w]; rest != 0; rest &= rest - 1)
      column(a, vector, w * 64 + std::countr_zero(rest), scratch);
    todo[w] = 0;
  }
}

HWY_INLINE WordLanes squared(const std::uint8_t* values) {
  const WordLanes wide = hn::PromoteTo(Words(), hn::LoadU(NarrowWords(), values));
  return hn::Mul(wide, wide);
}

/// The least of f(y + k) + k² over all k within reach. Farther ones than the value found so far
/// cannot be less.
HWY_INLINE WordLanes least_of_rows(const DistanceArrays& a, const std::uint8_t* slice,
                                   std::ptrdiff_t y) {
  constexpr Words d;
  const std::int32_t* const row_at = a.row_at + y;
  WordLanes least = hn::Min(squared(slice + row_at[0]), hn::Set(d, a.cap));
  for (int k = 1; k < a.reach; ++k) {
    const WordLanes square = hn::Set(d, static_cast<std::uint16_t>(k * k));
    if (hn::AllTrue(d, hn::Eq(hn::Max(least, square), square))) break;
    const auto nearer = hn::Min(hn::LoadU(NarrowWords(), slice + row_at[k]),
                                hn::LoadU(NarrowWords(), slice + row_at[-k]));
    const WordLanes wide = hn::PromoteTo(d, nearer);
    least = hn::Min(least, hn::SaturatedAdd(square, hn::Mul(wide, wide)));
  }
  return least;
}

HWY_INLINE WordLanes least_of_line(const DistanceArrays& a, const std::uint16_t* at) {
  constexpr Words d;
  WordLanes least = hn::LoadU(d, at);
  for (int k = 1; k < a.reach; ++k) {
    const WordLanes square = hn::Set(d, static_cast<std::uint16_t>(k * k));
    if (hn::AllTrue(d, hn::Eq(hn::Max(least, square), square))) break;
    const WordLanes nearer = hn::Min(hn::LoadU(d, at + k), hn::LoadU(d, at - k));
    least = hn::Min(least, hn::SaturatedAdd(square, nearer));
  }
  return least;
}

/// One vector of one row; marks what of its line may change with it.
HWY_INLINE void row_vector(const DistanceArrays& a, std::ptrdiff_t z, std::ptrdiff_t vector,
                           std::ptrdiff_t y) {
  constexpr Words d;
  const std::ptrdiff_t slice = a.slice_at[z], x = a.vector_at[vector] * kVector;
  for (int part = 0; part < kVector; part += kWordLanes) {
    const std::uint8_t* const input = a.along_z + slice * a.padded_slice + x + part;
    std::uint16_t* const output = a.within_slice + slice * a.slice + a.row_at[y] + x + part;
    const WordLanes least = least_of_rows(a, input, y);
    const WordLanes old = hn::LoadU(d, output);
    const auto is_same = hn::Eq(old, least);
    if (hn::AllTrue(d, is_same)) continue;
    hn::StoreU(least, d, output);
    const WordLanes changed = hn::IfThenElse(is_same, hn::Set(d, a.cap), hn::Min(old, least));
    const int span = a.reach_from[hn::GetLane(hn::MinOfLanes(d, changed))];
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(d, hn::Not(is_same), bytes);
    const std::uint32_t bits = bytes[0] | (std::uint32_t{bytes[1]} << 8U);
    const std::ptrdiff_t from = vector * kVector + part;
    const auto lowest = static_cast<std::ptrdiff_t>(std::countr_zero(bits));
    const auto highest = static_cast<std::ptrdiff_t>(std::bit_width(bits)) - 1;
    a.mark_line(z, y, from + lowest - span, from + highest + span);
  }
}

/// Lays a line out by position, with what is outside at both ends.
HWY_INLINE void lay_out(const DistanceArrays& a, const std::uint16_t* row, std::uint16_t* line) {
  const std::ptrdiff_t first = a.vector_at[0];
  const std::ptrdiff_t before_end = std::min(a.box_vectors, a.vectors - first);
  const auto bytes = [](std::ptrdiff_t vectors) {
    return static_cast<std::size_t>(vectors * kVector) * sizeof(std::uint16_t);
  };
  std::memcpy(line, row + first * kVector, bytes(before_end));
  std::memcpy(line + before_end * kVector, row, bytes(a.box_vectors - before_end));
}

HWY_INLINE void lines(const DistanceArrays& a, std::ptrdiff_t z, std::uint16_t* scratch) {
  constexpr Words d;
  const std::ptrdiff_t slice = a.slice_at[z] * a.slice;
  const std::uint16_t outside = a.is_outside_obstacle ? 0 : a.cap;
  std::uint16_t* const line = scratch + a.reach;
  std::fill(scratch, line, outside);
  std::fill_n(line + a.box_vectors * kVector, a.reach + 2 * kVector, outside);
  for (std::ptrdiff_t y = 0; y < a.rows; ++y) {
    std::uint64_t* const todo = a.lines_todo + (z * a.rows + y) * a.line_words;
    bool is_laid_out = false;
    for (std::ptrdiff_t w = 0; w < a.line_words; ++w) {
      for (std::uint64_t rest = todo[w]; rest != 0; rest &= rest - 1) {
        if (!is_laid_out) lay_out(a, a.within_slice + slice + a.row_at[y], line);
        is_laid_out = true;
        const std::ptrdiff_t vector = w * 64 + std::countr_zero(rest);
        std::uint16_t* const output =
            a.everywhere + slice + a.row_at[y] + a.vector_at[vector] * kVector;
        for (int part = 0; part < kVector; part += kWordLanes)
          hn::StoreU(least_of_line(a, line + vector * kVector + part), d, output + part);
      }
      todo[w] = 0;
    }
  }
}

void whole_slice(const DistanceArrays& a, std::ptrdiff_t z, std::uint16_t* scratch) {
  std::uint64_t* todo = a.rows_todo + z * a.box_vectors * a.row_words;
  for (std::ptrdiff_t vector = 0; vector < a.box_vectors; ++vector, todo += a.row_words) {
    for (std::ptrdiff_t w = 0; w < a.row_words; ++w) {
      for (std::uint64_t rest = todo[w]; rest != 0; rest &= rest - 1)
        row_vector(a, z, vector, w * 64 + std::countr_zero(rest));
      todo[w] = 0;
    }
  }
  if (a.has_lines[z] == 0) return;
  a.has_lines[z] = 0;
  lines(a, z, scratch);
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(classes);
HWY_EXPORT(columns);
HWY_EXPORT(whole_slice);

ObstacleClasses classes_of(const VoxelBlock& block, const OccupancyThresholds& thresholds) {
  return HWY_DYNAMIC_DISPATCH(classes)(block, thresholds);
}
void pass_columns(const DistanceArrays& arrays, std::ptrdiff_t vector, std::uint8_t* scratch) {
  HWY_DYNAMIC_DISPATCH(columns)(arrays, vector, scratch);
}
void pass_slice(const DistanceArrays& arrays, std::ptrdiff_t z, std::uint16_t* scratch) {
  HWY_DYNAMIC_DISPATCH(whole_slice)(arrays, z, scratch);
}

}  // namespace swiftlet
#endif
