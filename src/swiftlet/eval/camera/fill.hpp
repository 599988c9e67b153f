// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>

#include "swiftlet/frame/depth_image.hpp"

namespace swiftlet::eval {

/// How full a depth image is: the thesis's quality of a depth frame (method 9).
struct Fill {
  std::size_t valid = 0;   ///< pixels with a reading
  double of_image = 0.0;   ///< their share of the image
  double of_middle = 0.0;  ///< their share of the middle fifth of the image along both axes
};

/// REQUIRES: the image has five pixels and more along both axes.
[[nodiscard]] Fill measure_fill(const DepthImage& depth);

}  // namespace swiftlet::eval
