// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/image/depth_mean_pyramid.hpp"

#include <algorithm>

#include "swiftlet/base/voxel_index.hpp"

namespace swiftlet {
namespace {

constexpr int kLanes = 16;  // of the widest vectors

int tiles_of(int pixels, int shift) { return ((pixels - 1) >> shift) + 1; }

}  // namespace

void DepthMeanPyramid::lay_out(int width, int height, int threads) {
  width_ = width;
  height_ = height;
  scratch_.resize(static_cast<std::size_t>(threads));
  for (int shift = kFinestShift; shift <= kCoarsestShift; ++shift) {
    const auto place = static_cast<std::size_t>(shift - kFinestShift);
    Level& level = levels_[place];
    level.rows = tiles_of(height, shift);
    // The next level takes twice the lanes.
    level.stride = (tiles_of(width, shift) + 2 * kLanes - 1) / (2 * kLanes) * (2 * kLanes);
    const auto stride = static_cast<std::size_t>(level.stride);
    // An even number of rows: the next level takes two at a time.
    level.words.assign(static_cast<std::size_t>((level.rows + 1) / 2 * 2) * stride, 0);
    for (Scratch& scratch : scratch_) {
      for (std::vector<float>* part :
           {&scratch[place].count, &scratch[place].mean_m, &scratch[place].variance_m2})
        part->assign(2 * stride, 0.0F);
    }
  }
  below_.assign(static_cast<std::size_t>(width), 0);
}

void DepthMeanPyramid::build(const Image<std::uint16_t>& raw, const Options& options,
                             WorkerTeam& team) {
  if (raw.width() != width_ || raw.height() != height_)
    lay_out(raw.width(), raw.height(), team.threads());
  team.run([&](int worker) {
    Scratch& scratch = scratch_[static_cast<std::size_t>(worker)];
    for (int y = worker; y < levels_.back().rows; y += team.threads())
      make_row(raw, kCoarsestShift, y, options, scratch);
  });
}

void DepthMeanPyramid::make_row(const Image<std::uint16_t>& raw, int shift, int y,
                                const Options& options, Scratch& scratch) {
  const auto place = static_cast<std::size_t>(shift - kFinestShift);
  const DepthMeanRow row = row_of(shift, y, options, scratch[place]);
  if (y >= levels_[place].rows) {
    std::fill_n(row.count, levels_[place].stride, 0.0F);
  } else if (shift == kFinestShift) {
    const std::uint16_t* lower = 2 * y + 1 < height_ ? raw.row(2 * y + 1).data() : below_.data();
    average_pixels(raw.row(2 * y).data(), lower, row);
  } else {
    make_row(raw, shift - 1, 2 * y, options, scratch);
    make_row(raw, shift - 1, 2 * y + 1, options, scratch);
    merge_means(finer(shift - 1, 2 * y, scratch), finer(shift - 1, 2 * y + 1, scratch), row);
  }
}

DepthMeanRow DepthMeanPyramid::row_of(int shift, int y, const Options& options, RowPair& rows) {
  Level& to = levels_[static_cast<std::size_t>(shift - kFinestShift)];
  const auto stride = static_cast<std::size_t>(to.stride);
  const std::size_t first = static_cast<std::size_t>(y) % 2 * stride;
  const auto seed = options.frame_number * 65536U + static_cast<std::uint64_t>(8 * y + shift);
  return {.tiles = tiles_of(width_, shift),
          .image_width = width_,
          .pixel_rows = std::min((y + 1) << shift, height_) - (y << shift),
          .shift = shift,
          .unit_m = options.unit_m,
          .sigma_per_z2 = options.sigma_per_z2,
          .most_scatter_m = options.most_scatter_m,
          .seed = static_cast<std::uint32_t>(mix_bits(seed)),
          .count = &rows.count[first],
          .mean_m = &rows.mean_m[first],
          .variance_m2 = &rows.variance_m2[first],
          .words = &to.words[static_cast<std::size_t>(y) * stride]};
}

FinerMeanRow DepthMeanPyramid::finer(int shift, int y, const Scratch& scratch) const {
  const auto place = static_cast<std::size_t>(shift - kFinestShift);
  const auto stride = static_cast<std::size_t>(levels_[place].stride);
  const std::size_t first = static_cast<std::size_t>(y) % 2 * stride;
  const RowPair& rows = scratch[place];
  return {&rows.count[first], &rows.mean_m[first], &rows.variance_m2[first],
          &levels_[place].words[static_cast<std::size_t>(y) * stride]};
}

DepthMeanTiles DepthMeanPyramid::tiles(int shift) const {
  const int level = std::clamp(shift, kFinestShift, kCoarsestShift);
  const Level& of = levels_[static_cast<std::size_t>(level - kFinestShift)];
  return {of.words.data(), of.stride, level};
}

std::size_t DepthMeanPyramid::memory_bytes() const {
  std::size_t bytes = below_.capacity() * sizeof(std::uint16_t);
  for (const Level& level : levels_) bytes += level.words.capacity() * sizeof(std::int32_t);
  for (const Scratch& scratch : scratch_) {
    for (const RowPair& rows : scratch) bytes += 3 * rows.count.capacity() * sizeof(float);
  }
  return bytes;
}

}  // namespace swiftlet
