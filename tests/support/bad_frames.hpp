// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "support/seeds.hpp"
#include "swiftlet/frame/depth_image.hpp"

namespace swiftlet::test {

/// 848 x 480 pixels of a wall at 3 m and boxes at 1 to 2 m before it, with noise.
inline DepthImage boxes_before_a_wall(Random& random) {
  DepthImage depth{Image<std::uint16_t>(848, 480), 0.001F};
  for (std::uint16_t& d : depth.raw.pixels())
    d = static_cast<std::uint16_t>(std::lround(3000.0 + random.gaussian(12.0)));
  for (int i = 0; i < 6; ++i) {
    const int u0 = 20 + 140 * i, v0 = random.integer(60, 200);
    const double z_mm = random.real(1000.0, 2000.0);
    for (int v = v0; v < v0 + 160; ++v) {
      for (int u = u0; u < u0 + 70; ++u)
        depth.raw.at(u, v) = static_cast<std::uint16_t>(std::lround(z_mm + random.gaussian(3.0)));
    }
  }
  return depth;
}

/// The mean over lines of 2 n + 1 pixels, along rows and along columns: what moves during the
/// exposure.
inline DepthImage smeared(const DepthImage& sharp, int along_u, int along_v) {
  DepthImage blurred = sharp;
  const int width = sharp.raw.width(), height = sharp.raw.height();
  for (int v = 0; v < height; ++v) {
    for (int u = 0; u < width; ++u) {
      double sum = 0.0;
      int count = 0;
      for (int b = std::max(v - along_v, 0); b <= std::min(v + along_v, height - 1); ++b) {
        for (int a = std::max(u - along_u, 0); a <= std::min(u + along_u, width - 1); ++a) {
          sum += sharp.raw.at(a, b);
          ++count;
        }
      }
      blurred.raw.at(u, v) = static_cast<std::uint16_t>(std::lround(sum / count));
    }
  }
  return blurred;
}

}  // namespace swiftlet::test
