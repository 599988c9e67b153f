// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/condition/conditioned_depth.hpp"

namespace swiftlet {

/// When two neighbouring readings belong to one surface: they differ by less than noise and slope
/// explain. In device units: least + per_depth z + per_square z^2.
struct NoiseTolerance {
  float least = 1.0F;  ///< quantisation
  float per_depth;
  float per_square;
};

/// Three deviations of the difference of two readings, and a surface whose depth changes by a
/// hundredth from one pixel to the next: at 415 px of focal length that is 76 degrees of incidence.
[[nodiscard]] NoiseTolerance noise_tolerance(const ConditionedDepth& depth);

/// An image with a border of readings that are none, so that every pixel has all its neighbours.
/// Allocates only when the size of images changes.
class BorderedImage {
 public:
  static constexpr int kBorder = 2;
  static constexpr int kSlack = 64;  ///< pixels that a vector may reach beyond a row

  void take(const Image<std::uint16_t>& image);
  /// Row v of the image, of which the pixels -kBorder .. width + kBorder can be read, and whole
  /// vectors behind. REQUIRES: -kBorder <= v < height + kBorder.
  [[nodiscard]] const std::uint16_t* row(int v) const {
    return &pixels_[static_cast<std::size_t>(v + kBorder) * stride_ + kBorder];
  }

 private:
  int width_ = 0, height_ = 0;
  std::size_t stride_ = 0;
  std::vector<std::uint16_t> pixels_;
};

/// One row to be gathered, and where to.
struct NeighbourRow {
  const BorderedImage* image;
  int v;
  const std::uint16_t* tolerance;
  std::uint16_t* count;
  std::uint16_t* sum;
};

/// How many of the readings around each pixel of a row agree with it, and how much deeper they are
/// together: on the widest vectors of this machine, the same values on all of them.
/// Real time: allocates only when the size of images changes.
class NeighbourSums {
 public:
  /// Replaces every pixel of an image by pick(pixel, count, sum): how many readings of the square
  /// of 3 x 3 (reach 1) or 5 x 5 (reach 2) around it agree with it, itself included, and the sum of
  /// their differences to it, in device units. A pixel without a reading agrees with those that
  /// have none.
  template <class Pick>
  void replace_each(ConditionedDepth& depth, int reach, Pick&& pick) {
    const NoiseTolerance tolerance = noise_tolerance(depth);
    take(depth.raw);
    for (int v = 0; v < depth.raw.height(); ++v) {
      gather(v, reach, tolerance);
      const auto row = depth.raw.row(v);
      for (std::size_t u = 0; u < row.size(); ++u)
        row[u] = pick(row[u], int{count_[u]}, int{static_cast<std::int16_t>(sum_[u])});
    }
  }

 private:
  void take(const Image<std::uint16_t>& image);
  void gather(int v, int reach, const NoiseTolerance& tolerance);

  BorderedImage image_;
  int width_ = 0;
  std::vector<std::uint16_t> tolerance_, count_, sum_;  // of one row, and room for a vector
};

}  // namespace swiftlet
