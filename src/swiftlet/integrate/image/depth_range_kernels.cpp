// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/image/depth_range_kernels.hpp"

#include <algorithm>

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/image/depth_range_kernels.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Raws = hn::CappedTag<std::uint16_t, 32>;
using RawLanes = hn::Vec<Raws>;

constexpr int kTile = DepthRangePyramid::kTile;

/// Running summary of pixels. A missing reading is 0: one less wraps round to the largest value, so
/// that it never wins as the nearest.
struct Summary {
  RawLanes nearest_less_1, farthest, missing;

  HWY_INLINE void add(RawLanes raw) {
    constexpr Raws r;
    nearest_less_1 = hn::Min(nearest_less_1, hn::Sub(raw, hn::Set(r, 1)));
    farthest = hn::Max(farthest, raw);
    const RawLanes is_missing = hn::VecFromMask(r, hn::Eq(raw, hn::Zero(r)));
    missing = hn::Sub(missing, is_missing);  // a true lane is -1
  }
};

/// Whole tiles from pixel column `u`, as many as there are lanes.
HWY_INLINE std::size_t add_tiles(const std::uint16_t* const rows[kTile], int u,
                                 std::int32_t* tiles) {
  constexpr Raws r;
  Summary sum{hn::Set(r, 0xffff), hn::Zero(r), hn::Zero(r)};
  for (int row = 0; row < kTile; ++row) {
    RawLanes column[kTile];
    hn::LoadInterleaved4(r, rows[row] + u, column[0], column[1], column[2], column[3]);
    for (const RawLanes& raw : column) sum.add(raw);
  }
  HWY_ALIGN std::uint16_t nearest[32], farthest[32], missing[32];
  hn::Store(hn::Add(sum.nearest_less_1, hn::Set(r, 1)), r, nearest);
  hn::Store(sum.farthest, r, farthest);
  hn::Store(sum.missing, r, missing);
  std::size_t readings = 0;
  for (std::size_t i = 0; i < hn::Lanes(r); ++i) {
    tiles[i] = DepthRangePyramid::word_of(nearest[i], farthest[i], missing[i] != 0);
    readings += static_cast<std::size_t>(kTile * kTile - missing[i]);
  }
  return readings;
}

std::size_t tile_row(const std::uint16_t* const rows[kTile], int tiles, std::int32_t* out) {
  const auto step = static_cast<int>(hn::Lanes(Raws()));
  std::size_t readings = 0;
  for (int t = 0; t + step <= tiles; t += step) readings += add_tiles(rows, kTile * t, out + t);
  return readings;
}

int lanes() { return static_cast<int>(hn::Lanes(Raws())); }

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {
namespace {

HWY_EXPORT(tile_row);
HWY_EXPORT(lanes);

/// Tiles that the image's edge cuts, and those that fill no vector.
std::int32_t find_tile_range(const Image<std::uint16_t>& raw, int x, int y, std::size_t& readings) {
  constexpr int kTile = DepthRangePyramid::kTile;
  const int u_end = std::min((x + 1) * kTile, raw.width());
  const int v_end = std::min((y + 1) * kTile, raw.height());
  std::uint16_t nearest = 0, farthest = 0;
  bool has_gaps = false;
  for (int v = y * kTile; v < v_end; ++v) {
    for (int u = x * kTile; u < u_end; ++u) {
      const std::uint16_t d = raw.at(u, v);
      has_gaps = has_gaps || d == 0;
      if (d == 0) continue;
      ++readings;
      nearest = nearest == 0 ? d : std::min(nearest, d);
      farthest = std::max(farthest, d);
    }
  }
  return DepthRangePyramid::word_of(nearest, farthest, has_gaps);
}

}  // namespace

std::size_t find_tile_row_ranges(const Image<std::uint16_t>& raw, int tile_row_index,
                                 std::int32_t* tiles) {
  constexpr int kTile = DepthRangePyramid::kTile;
  const int all = (raw.width() + kTile - 1) / kTile, whole = raw.width() / kTile;
  std::size_t readings = 0;
  int done = 0;
  if ((tile_row_index + 1) * kTile <= raw.height()) {
    const std::uint16_t* rows[kTile];
    for (int i = 0; i < kTile; ++i) rows[i] = raw.row(tile_row_index * kTile + i).data();
    const int step = HWY_DYNAMIC_DISPATCH(lanes)();
    done = whole / step * step;
    readings += HWY_DYNAMIC_DISPATCH(tile_row)(rows, done, tiles);
  }
  for (int x = done; x < all; ++x) tiles[x] = find_tile_range(raw, x, tile_row_index, readings);
  return readings;
}

}  // namespace swiftlet
#endif
