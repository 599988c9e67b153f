// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/base/image.hpp"
#include "swiftlet/base/worker_team.hpp"
#include "swiftlet/integrate/image/depth_mean_kernels.hpp"

namespace swiftlet {

/// Mean and scatter of the readings in tiles of 2 x 2 pixels, of 4 x 4 and so on: what a whole tile
/// says about a voxel can be told from these, pixel by pixel need not be looked at.
///
/// That holds while the readings scatter like noise or a slope. Across the edge of an object a mean
/// would lie in the empty space behind it: such a tile takes the depth of one of its parts,
/// drawn with the chance of its readings and anew in every frame.
class DepthMeanPyramid {
 public:
  static constexpr int kFinestShift = 1;
  static constexpr int kCoarsestShift = 5;

  struct Options {
    float unit_m;
    float sigma_per_z2;    ///< deviation of a reading at 1 m [m]
    float most_scatter_m;  ///< more scatter than this, and than noise makes, is an edge
    std::uint64_t frame_number;
  };
  /// Allocates only while images grow.
  void build(const Image<std::uint16_t>& raw, const Options& options, WorkerTeam& team);

  [[nodiscard]] DepthMeanTiles tiles(int shift) const;

  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  /// One level. Rows are padded to whole vectors: beyond the image, tiles have no readings.
  struct Level {
    int rows = 0, stride = 0;
    std::vector<std::int32_t> words;
  };
  /// Two rows of tiles of a level, which the next one is made from: they stay in the cache.
  struct RowPair {
    std::vector<float> count, mean_m, variance_m2;
  };
  static constexpr int kLevels = kCoarsestShift - kFinestShift + 1;
  using Scratch = std::array<RowPair, kLevels>;

  void lay_out(int width, int height, int threads);
  void make_row(const Image<std::uint16_t>& raw, int shift, int y, const Options& options,
                Scratch& scratch);
  DepthMeanRow row_of(int shift, int y, const Options& options, RowPair& rows);
  FinerMeanRow finer(int shift, int y, const Scratch& scratch) const;

  int width_ = 0, height_ = 0;
  std::vector<std::uint16_t> below_;  // the row under the last one: no readings
  std::array<Level, kLevels> levels_;
  std::vector<Scratch> scratch_;  // of each thread
};

}  // namespace swiftlet
