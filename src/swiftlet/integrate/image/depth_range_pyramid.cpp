// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/image/depth_range_pyramid.hpp"

#include <algorithm>

#include "swiftlet/integrate/image/depth_range_kernels.hpp"

namespace swiftlet {
namespace {

/// Two tiles as one.
std::int32_t joined(std::int32_t tile_a, std::int32_t tile_b) {
  constexpr std::uint32_t kGaps = DepthRangePyramid::kHasGaps, kNearest = 0xffffU & ~kGaps;
  const auto a = static_cast<std::uint32_t>(tile_a), b = static_cast<std::uint32_t>(tile_b);
  const std::uint32_t farthest = std::max(a, b) & 0xffff'0000U;
  return static_cast<std::int32_t>(farthest | std::min(a & kNearest, b & kNearest) |
                                   ((a | b) & kGaps));
}

}  // namespace

void DepthRangePyramid::lay_out(int width, int height) {
  width_ = width;
  height_ = height;
  levels_.clear();
  std::size_t tiles = 0;
  for (int shift = kTileShift;; ++shift) {
    const auto count = [shift](int pixels) {
      return static_cast<std::size_t>((pixels - 1) >> shift) + 1;
    };
    const Level level{count(width), count(height), tiles};
    levels_.push_back(level);
    tiles += level.width * level.height;
    if (level.width == 1 && level.height == 1) break;
  }
  words_.resize(tiles);
}

void DepthRangePyramid::build(const Image<std::uint16_t>& raw) {
  if (raw.width() != width_ || raw.height() != height_) lay_out(raw.width(), raw.height());
  const Level& finest = levels_.front();
  readings_ = 0;
  for (std::size_t y = 0; y < finest.height; ++y)
    readings_ += find_tile_row_ranges(raw, static_cast<int>(y), &words_[y * finest.width]);
  for (std::size_t i = 1; i < levels_.size(); ++i) merge(levels_[i - 1], levels_[i]);
}

void DepthRangePyramid::merge(const Level& from, const Level& to) {
  for (std::size_t y = 0; y < to.height; ++y) {
    const std::int32_t* upper = &words_[from.first + 2 * y * from.width];
    const std::int32_t* lower = 2 * y + 1 < from.height ? upper + from.width : upper;
    std::int32_t* out = &words_[to.first + y * to.width];
    const std::size_t pairs = from.width / 2;
    for (std::size_t x = 0; x < pairs; ++x)
      out[x] =
          joined(joined(upper[2 * x], upper[2 * x + 1]), joined(lower[2 * x], lower[2 * x + 1]));
    if (pairs < to.width) out[pairs] = joined(upper[2 * pairs], lower[2 * pairs]);
  }
}

DepthRangeTiles DepthRangePyramid::tiles() const {
  DepthRangeTiles tiles{words_.data(), static_cast<int>(levels_.size()), {}, {}};
  for (std::size_t i = 0; i < levels_.size(); ++i) {
    tiles.first[i] = static_cast<std::int32_t>(levels_[i].first);
    tiles.width[i] = static_cast<std::int32_t>(levels_[i].width);
  }
  return tiles;
}

}  // namespace swiftlet
