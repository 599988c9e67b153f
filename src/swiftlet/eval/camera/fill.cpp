// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/camera/fill.hpp"

#include "swiftlet/base/contract.hpp"

namespace swiftlet::eval {

Fill measure_fill(const DepthImage& depth) {
  const int width = depth.raw.width(), height = depth.raw.height();
  SWIFTLET_REQUIRE(width >= 5 && height >= 5, "an image has a middle");
  const int u0 = 2 * width / 5, u1 = 3 * width / 5, v0 = 2 * height / 5, v1 = 3 * height / 5;
  Fill fill;
  std::size_t middle = 0;
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      if (depth.raw.at(u, v) == 0) continue;
      ++fill.valid;
      middle += u >= u0 && u < u1 && v >= v0 && v < v1 ? 1 : 0;
    }
  }
  const auto share = [](std::size_t part, int columns, int rows) {
    return static_cast<double>(part) / (static_cast<double>(columns) * rows);
  };
  fill.of_image = share(fill.valid, width, height);
  fill.of_middle = share(middle, u1 - u0, v1 - v0);
  return fill;
}

}  // namespace swiftlet::eval
