// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/preprocess/preprocessed_depth.hpp"

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
[[nodiscard]] NoiseTolerance noise_tolerance(const PreprocessedDepth& depth);

/// An image with a border of readings that are none, so that every pixel has all its neighbours.
/// Allocates only when the size of images changes.
class BorderedImage {
 public:
  static constexpr int kSlack = 64;  ///< pixels that a vector may reach beyond a row

  void take(const Image<std::uint16_t>& image);
  explicit BorderedImage(int border_px) : border_(border_px) {}

  /// Row v of the image, of which the pixels -border .. width + border can be read, and whole
  /// vectors behind. REQUIRES: -border <= v < height + border.
  [[nodiscard]] const std::uint16_t* row(int v) const {
    return &pixels_[static_cast<std::size_t>(v + border_) * stride_ +
                    static_cast<std::size_t>(border_)];
  }
  [[nodiscard]] std::size_t memory_bytes() const { return pixels_.capacity() * sizeof(pixels_[0]); }

 private:
  int border_, width_ = 0, height_ = 0;
  std::size_t stride_ = 0;
  std::vector<std::uint16_t> pixels_;
};

/// One row of an image, and room for what is known of it.
struct NeighbourRow {
  const BorderedImage* image;
  int v, width;
  NoiseTolerance noise;
  std::uint16_t *tolerance, *count, *sum, *result;
};

/// Replaces readings by what those around them say, on the widest vectors of this machine: the same
/// values on all of them. Two readings agree if they differ by no more than noise_tolerance() at
/// the one that asks; 0, no reading, stays 0 and agrees with none.
/// Real time: allocates only when the size of images changes.
class Neighbours {
 public:
  /// A reading needs so many of the 3 x 3 around it that agree with it, itself included: a rod of
  /// two pixels has five or six.
  static constexpr int kLeast = 3;

  /// Drops every reading that has fewer.
  void keep_supported(PreprocessedDepth& depth);
  /// Drops them, and replaces the others by the mean of those of the 5 x 5 around them that agree
  /// with them.
  void average(PreprocessedDepth& depth);

 private:
  template <class MakeRow>
  void replace_rows(PreprocessedDepth& depth, MakeRow make_row);

  BorderedImage image_{2};
  std::vector<std::uint16_t> tolerance_, count_, sum_, result_;  // of a row, and room for a vector
};

}  // namespace swiftlet
