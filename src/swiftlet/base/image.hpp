// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {

/// A dense row-major image that owns its pixels. Shape (height, width); rows are contiguous and
/// unpadded.
template <class T>
class Image {
 public:
  Image() = default;
  /// All pixels `fill`. REQUIRES: width and height not below 0.
  Image(int width, int height, T fill = T{}) { resize(width, height, fill); }

  /// Keeps the capacity, so a buffer that is used again for the same size does not allocate.
  void resize(int width, int height, T fill = T{}) {
    SWIFTLET_REQUIRE(width >= 0 && height >= 0, "an image has no negative side");
    width_ = width;
    height_ = height;
    pixels_.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), fill);
  }

  /// Columns [px]
  [[nodiscard]] int width() const { return width_; }
  /// Rows [px]
  [[nodiscard]] int height() const { return height_; }
  /// Whether there is no pixel.
  [[nodiscard]] bool empty() const { return pixels_.empty(); }

  /// REQUIRES: 0 <= u < width, 0 <= v < height (not checked: hot).
  [[nodiscard]] T& at(int u, int v) { return pixels_[offset(u, v)]; }
  /// The pixel in column u of row v. REQUIRES: inside the image (not checked: hot).
  [[nodiscard]] const T& at(int u, int v) const { return pixels_[offset(u, v)]; }

  /// Row v, from left to right. REQUIRES: 0 <= v < height().
  [[nodiscard]] std::span<T> row(int v) {
    return {&pixels_[offset(0, v)], static_cast<std::size_t>(width_)};
  }
  /// Row v, from left to right. REQUIRES: 0 <= v < height().
  [[nodiscard]] std::span<const T> row(int v) const {
    return {&pixels_[offset(0, v)], static_cast<std::size_t>(width_)};
  }
  /// All pixels, row by row.
  [[nodiscard]] std::span<T> pixels() { return pixels_; }
  /// All pixels, row by row.
  [[nodiscard]] std::span<const T> pixels() const { return pixels_; }

 private:
  [[nodiscard]] std::size_t offset(int u, int v) const {
    return static_cast<std::size_t>(v) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(u);
  }

  int width_ = 0;
  int height_ = 0;
  std::vector<T> pixels_;
};

}  // namespace swiftlet
