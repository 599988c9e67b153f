// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/depth_pyramid.hpp"

#include <algorithm>
#include <atomic>
#include <bit>

#include "swiftlet/integrate/depth_tiles.hpp"

namespace swiftlet {
namespace {

/// Pixels of an image side that a tile covers: fewer than its width at the far edge.
int pixels_in(int tile, int shift, int size) {
  return std::min((tile + 1) << shift, size) - (tile << shift);
}

}  // namespace

void DepthPyramid::lay_out(int width, int height) {
  width_ = width;
  height_ = height;
  levels_.clear();
  std::size_t tiles = 0;
  for (int shift = kTileShift;; ++shift) {
    const auto count = [shift](int pixels) { return ((pixels - 1) >> shift) + 1; };
    const Level level{count(width), count(height), tiles};
    levels_.push_back(level);
    tiles += static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
    if (level.width == 1 && level.height == 1) break;
  }
  tiles_.resize(tiles);
}

void DepthPyramid::build(const Image<std::uint16_t>& raw, WorkerTeam& team) {
  if (raw.width() != width_ || raw.height() != height_) lay_out(raw.width(), raw.height());
  const Level& finest = levels_.front();
  std::atomic<std::size_t> readings{0};
  team.run([&](int worker) {
    std::size_t mine = 0;
    for (int y = worker; y < finest.height; y += team.threads())
      mine += summarise_tile_row(
          raw, y, &tiles_[static_cast<std::size_t>(y) * static_cast<std::size_t>(finest.width)]);
    readings += mine;
  });
  readings_ = readings;
  for (std::size_t i = 1; i < levels_.size(); ++i)
    merge(levels_[i - 1], levels_[i], kTileShift + static_cast<int>(i) - 1);
}

void DepthPyramid::merge(const Level& from, const Level& to, int tile_shift) {
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      DepthTile sum;
      float valid = 0.0F, all = 0.0F;
      for (int sy = 2 * y; sy < std::min(2 * y + 2, from.height); ++sy) {
        for (int sx = 2 * x; sx < std::min(2 * x + 2, from.width); ++sx) {
          const DepthTile& part = tile(from, sx, sy);
          const auto pixels = static_cast<float>(pixels_in(sx, tile_shift, width_) *
                                                 pixels_in(sy, tile_shift, height_));
          sum.nearest = std::min(sum.nearest, part.nearest);
          sum.farthest = std::max(sum.farthest, part.farthest);
          valid += part.valid * pixels;
          all += pixels;
        }
      }
      sum.valid = valid / all;
      tiles_[to.first + static_cast<std::size_t>(y * to.width + x)] = sum;
    }
  }
}

DepthRange DepthPyramid::range_of(const PixelRect& rect) const {
  // The level whose tiles are at most half as wide as the rectangle: at most 3 x 3 tiles, and
  // little more than what was asked for.
  const auto longest = static_cast<unsigned>(std::max(rect.u1 - rect.u0, rect.v1 - rect.v0) + 1);
  const int wanted = static_cast<int>(std::bit_width(longest)) - 2 - kTileShift;
  const int index = std::clamp(wanted, 0, static_cast<int>(levels_.size()) - 1);
  const int shift = kTileShift + index;
  DepthRange range;
  for (int y = rect.v0 >> shift; y <= rect.v1 >> shift; ++y) {
    for (int x = rect.u0 >> shift; x <= rect.u1 >> shift; ++x) {
      const DepthTile& t = tile(level(index), x, y);
      range.nearest = std::min(range.nearest, t.nearest);
      range.farthest = std::max(range.farthest, t.farthest);
      range.is_complete = range.is_complete && t.valid == 1.0F;
    }
  }
  return range;
}

}  // namespace swiftlet
