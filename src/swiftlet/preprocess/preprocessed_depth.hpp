// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "swiftlet/base/image.hpp"
#include "swiftlet/frame/intrinsics.hpp"

namespace swiftlet {

/// Where a reduced pixel comes from and how well it is supported.
struct PixelOrigin {
  std::uint16_t u = 0;        ///< column in the full image
  std::uint16_t v = 0;        ///< row in the full image
  std::uint16_t valid = 0;    ///< valid pixels in its n x n block, itself included
  std::uint16_t support = 0;  ///< of those, the ones close to its depth, itself included
};

/// A depth image on its way to the map. Shape (ceil(height / n), ceil(width / n)) uint16 device
/// units, 0 = no reading.
struct PreprocessedDepth {
  Image<std::uint16_t> raw;
  float unit_m = 0.001F;                          ///< metres per device unit
  std::optional<PinholeIntrinsics> intrinsics{};  ///< of the full image; nullopt: not told
  int ratio = 1;  ///< n: how many pixels of the full image one pixel stands for, along each side
  Image<PixelOrigin> origin;  ///< same shape as raw; empty while ratio is 1
  /// Deviation of a reading as the sensor made it, over the square of its depth [1/m]: s / (f B).
  float sigma_per_z2 = 0.004F;
  float noise_left = 1.0F;  ///< share of that deviation that steps have left

  /// Where reduced pixel (u, v) was measured in the full image.
  [[nodiscard]] PixelOrigin origin_of(int u, int v) const {
    if (ratio > 1) return origin.at(u, v);
    return {static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(v), 1, 1};
  }
};

}  // namespace swiftlet
