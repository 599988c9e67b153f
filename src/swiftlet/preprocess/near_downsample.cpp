// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "swiftlet/base/narrow.hpp"
#include "swiftlet/preprocess/depth_step.hpp"
#include "swiftlet/preprocess/near_kernels.hpp"

namespace swiftlet {
namespace {

/// A reading counts as support when it lies at most one part in so many behind the nearest.
constexpr int kSupportParts = 20;

/// What the n rows of a row of blocks hold in one column of the image.
struct Columns {
  std::vector<std::uint16_t> nearest_less_1, row, valid, support;  ///< as in near_kernels.hpp
  std::vector<std::uint16_t> limit;  ///< readings up to here are support of the block

  void start(std::size_t width) {
    nearest_less_1.assign(width, 0xffff);
    row.assign(width, 0);
    valid.assign(width, 0);
    support.assign(width, 0);
    limit.resize(width);
  }
};

/// Method 2: every n x n block becomes its smallest valid depth, with the pixel it was measured at,
/// so that the point in space is a real one: of equal ones the first, row by row. Blocks cut off by
/// the right and lower edge count too.
class NearDownsample final : public DepthStep {
 public:
  explicit NearDownsample(const PreprocessOptions& o) : ratio_(o.downsample) {}

  void apply(PreprocessedDepth& depth) override {
    SWIFTLET_REQUIRE(depth.ratio == 1, "the image is reduced once");
    if (ratio_ <= 1) return;
    const auto blocks = [this](int pixels) { return (pixels + ratio_ - 1) / ratio_; };
    reduced_.resize(blocks(depth.raw.width()), blocks(depth.raw.height()));
    depth.origin.resize(reduced_.width(), reduced_.height());
    for (int v = 0; v < reduced_.height(); ++v) reduce_row(depth.raw, v, depth.origin.row(v));
    std::swap(depth.raw, reduced_);
    depth.ratio = ratio_;
  }

 private:
  void reduce_row(const Image<std::uint16_t>& raw, int block_v, std::span<PixelOrigin> origins) {
    const int v0 = block_v * ratio_, v1 = std::min(v0 + ratio_, raw.height());
    columns_.start(raw.row(v0).size());
    for (int v = v0; v < v1; ++v)
      add_row_of_readings(raw.row(v), to<std::uint16_t>(v - v0), columns_.nearest_less_1.data(),
                          columns_.row.data(), columns_.valid.data());
    const std::span<std::uint16_t> nearest = reduced_.row(block_v);
    for (std::size_t block_u = 0; block_u < origins.size(); ++block_u) {
      origins[block_u] = nearest_of(block_u, v0);
      nearest[block_u] = to<std::uint16_t>(
          origins[block_u].valid == 0 ? 0 : columns_.nearest_less_1[origins[block_u].u] + 1);
      const int limit = nearest[block_u] + nearest[block_u] / kSupportParts;
      const auto [first, end] = columns_of(block_u);
      std::fill(columns_.limit.begin() + first, columns_.limit.begin() + end,
                static_cast<std::uint16_t>(std::min(limit, 0xffff)));
    }
    for (int v = v0; v < v1; ++v)
      add_row_of_support(raw.row(v), columns_.limit.data(), columns_.support.data());
    for (std::size_t block_u = 0; block_u < origins.size(); ++block_u) {
      const auto [first, end] = columns_of(block_u);
      for (auto u = first; u < end; ++u)
        origins[block_u].support += columns_.support[static_cast<std::size_t>(u)];
    }
  }

  [[nodiscard]] std::pair<std::ptrdiff_t, std::ptrdiff_t> columns_of(std::size_t block_u) const {
    const auto first = static_cast<std::ptrdiff_t>(block_u) * ratio_;
    return {first, std::min(first + ratio_, std::ssize(columns_.row))};
  }

  [[nodiscard]] PixelOrigin nearest_of(std::size_t block_u, int v0) const {
    PixelOrigin nearest;
    // Smallest first, then its row, then its column.
    std::uint32_t least = 0xffff'ffff;
    const auto [first, end] = columns_of(block_u);
    for (auto column = first; column < end; ++column) {
      const auto u = static_cast<std::size_t>(column);
      nearest.valid += columns_.valid[u];
      const std::uint32_t place =
          std::uint32_t{columns_.nearest_less_1[u]} << 16U | columns_.row[u];
      if (place >= least) continue;
      least = place;
      nearest.u = to<std::uint16_t>(column);
      nearest.v = to<std::uint16_t>(v0 + columns_.row[u]);
    }
    return nearest.valid == 0 ? PixelOrigin{} : nearest;
  }

  int ratio_;
  Image<std::uint16_t> reduced_;
  Columns columns_;
};

}  // namespace

std::unique_ptr<DepthStep> make_near_downsample(const PreprocessOptions& options) {
  return std::make_unique<NearDownsample>(options);
}

}  // namespace swiftlet
