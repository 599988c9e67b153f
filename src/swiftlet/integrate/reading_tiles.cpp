// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/reading_tiles.hpp"

#include <algorithm>

#include "swiftlet/base/voxel_index.hpp"

namespace swiftlet {
namespace {

constexpr int kLanes = 16;  // of the widest vectors

int tiles_of(int pixels, int shift) { return ((pixels - 1) >> shift) + 1; }

}  // namespace

void ReadingSummaries::lay_out(int width, int height) {
  width_ = width;
  height_ = height;
  for (int shift = kFinestShift; shift <= kCoarsestShift; ++shift) {
    Level& level = levels_[shift - kFinestShift];
    // An even number of rows: the next level takes two at a time.
    level.rows = (tiles_of(height, shift) + 1) / 2 * 2;
    // The next level takes twice the lanes.
    level.stride = (tiles_of(width, shift) + 2 * kLanes - 1) / (2 * kLanes) * (2 * kLanes);
    const auto count =
        static_cast<std::size_t>(level.rows) * static_cast<std::size_t>(level.stride);
    level.count.assign(count, 0.0F);
    level.mean_m.assign(count, 0.0F);
    level.variance_m2.assign(count, 0.0F);
    level.words.assign(count, 0);
  }
  below_.assign(static_cast<std::size_t>(width), 0);
}

FinerRow ReadingSummaries::finer(const Level& level, int y) {
  const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(level.stride);
  return {&level.count[first], &level.mean_m[first], &level.variance_m2[first],
          &level.words[first]};
}

void ReadingSummaries::build(const Image<std::uint16_t>& raw, const Options& options,
                             WorkerTeam& team) {
  if (raw.width() != width_ || raw.height() != height_) lay_out(raw.width(), raw.height());
  team.run([&](int worker) {
    for (int y = worker; y < tiles_of(height_, kFinestShift); y += team.threads()) {
      const std::uint16_t* lower = 2 * y + 1 < height_ ? raw.row(2 * y + 1).data() : below_.data();
      summarise_pixels(raw.row(2 * y).data(), lower, row_of(kFinestShift, y, options));
    }
  });
  for (int shift = kFinestShift + 1; shift <= kCoarsestShift; ++shift) {
    for (int y = 0; y < tiles_of(height_, shift); ++y) {
      const Level& from = levels_[shift - kFinestShift - 1];
      merge_summaries(finer(from, 2 * y), finer(from, 2 * y + 1), row_of(shift, y, options));
    }
  }
}

SummaryRow ReadingSummaries::row_of(int shift, int y, const Options& options) {
  Level& to = levels_[shift - kFinestShift];
  const auto first = static_cast<std::size_t>(y) * static_cast<std::size_t>(to.stride);
  const auto seed = options.frame_number * 65536U + static_cast<std::uint64_t>(8 * y + shift);
  return {.tiles = tiles_of(width_, shift),
          .image_width = width_,
          .pixel_rows = std::min((y + 1) << shift, height_) - (y << shift),
          .shift = shift,
          .unit_m = options.unit_m,
          .sigma_per_z2 = options.sigma_per_z2,
          .most_scatter_m = options.most_scatter_m,
          .seed = static_cast<std::uint32_t>(mix_bits(seed)),
          .count = &to.count[first],
          .mean_m = &to.mean_m[first],
          .variance_m2 = &to.variance_m2[first],
          .words = &to.words[first]};
}

ReadingTiles ReadingSummaries::tiles(int shift) const {
  const Level& level = levels_[std::clamp(shift, kFinestShift, kCoarsestShift) - kFinestShift];
  return {level.words.data(), level.stride, std::clamp(shift, kFinestShift, kCoarsestShift)};
}

std::size_t ReadingSummaries::memory_bytes() const {
  std::size_t bytes = below_.capacity() * sizeof(std::uint16_t);
  for (const Level& level : levels_) bytes += level.count.capacity() * 4 * sizeof(float);
  return bytes;
}

}  // namespace swiftlet
