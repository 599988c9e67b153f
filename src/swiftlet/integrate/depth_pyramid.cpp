// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/depth_pyramid.hpp"

#include <algorithm>
#include <bit>

namespace swiftlet {
namespace {

constexpr DepthRange kNothing{0xffff, 0, 0xffff};

DepthRange join(const DepthRange& a, const DepthRange& b) {
  return {std::min(a.nearest, b.nearest), std::max(a.farthest, b.farthest),
          std::min(a.smallest, b.smallest)};
}

}  // namespace

void DepthPyramid::build(const Image<std::uint16_t>& raw) {
  levels_.clear();
  std::size_t tiles = 0;
  for (int shift = kTileShift;; ++shift) {
    const auto count = [shift](int pixels) { return ((pixels - 1) >> shift) + 1; };
    const Level level{count(raw.width()), count(raw.height()), tiles};
    levels_.push_back(level);
    tiles += static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
    if (level.width == 1 && level.height == 1) break;
  }
  tiles_.resize(tiles);
  build_tiles(raw);
  for (std::size_t i = 1; i < levels_.size(); ++i) merge_tiles(levels_[i - 1], levels_[i]);
}

void DepthPyramid::build_tiles(const Image<std::uint16_t>& raw) {
  constexpr int kTile = 1 << kTileShift;
  const Level& level = levels_.front();
  for (int ty = 0; ty < level.height; ++ty) {
    DepthRange* tiles = &tiles_[static_cast<std::size_t>(ty) * level.width];
    std::fill_n(tiles, level.width, kNothing);
    const int v_end = std::min((ty + 1) * kTile, raw.height());
    for (int v = ty * kTile; v < v_end; ++v) {
      const std::uint16_t* row = raw.row(v).data();
      for (int u = 0; u < raw.width(); ++u) {
        DepthRange& tile = tiles[u >> kTileShift];
        const auto reading = static_cast<std::uint16_t>(row[u] == 0 ? 0xffff : row[u]);
        tile = join(tile, {reading, row[u], row[u]});
      }
    }
  }
}

void DepthPyramid::merge_tiles(const Level& from, const Level& to) {
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      DepthRange tile = kNothing;
      for (int sy = 2 * y; sy < std::min(2 * y + 2, from.height); ++sy) {
        for (int sx = 2 * x; sx < std::min(2 * x + 2, from.width); ++sx)
          tile = join(tile, tiles_[from.first + static_cast<std::size_t>(sy) * from.width + sx]);
      }
      tiles_[to.first + static_cast<std::size_t>(y) * to.width + x] = tile;
    }
  }
}

DepthRange DepthPyramid::range_of(const PixelRect& rect) const {
  // The level whose tiles are at most half as wide as the rectangle: at most 3 x 3 tiles, and
  // little more than what was asked for.
  const auto longest = static_cast<unsigned>(std::max(rect.u1 - rect.u0, rect.v1 - rect.v0) + 1);
  const int wanted = std::bit_width(longest) - 2 - kTileShift;
  const int level_index = std::clamp(wanted, 0, static_cast<int>(levels_.size()) - 1);
  const Level& level = levels_[static_cast<std::size_t>(level_index)];
  const int shift = kTileShift + level_index;
  DepthRange range = kNothing;
  for (int y = rect.v0 >> shift; y <= rect.v1 >> shift; ++y) {
    const DepthRange* row = &tiles_[level.first + static_cast<std::size_t>(y) * level.width];
    for (int x = rect.u0 >> shift; x <= rect.u1 >> shift; ++x) range = join(range, row[x]);
  }
  return range;
}

}  // namespace swiftlet
