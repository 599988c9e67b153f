// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>

#include "swiftlet/base/image.hpp"

namespace swiftlet {

/// Depth as the sensor delivers it: z along the optical axis, in device units, 0 = no reading.
/// Shape (height, width) uint16. Sources turn every other mark of "no reading" (65535, NaN) into 0.
struct DepthImage {
  /// (rows, cols) raw readings; 0 is none.
  Image<std::uint16_t> raw;
  float unit_m = 0.001F;  ///< metres per device unit

  /// The reading of a pixel [m]; 0 if there is none. REQUIRES: inside the image.
  [[nodiscard]] float depth_m(int u, int v) const {
    return static_cast<float>(raw.at(u, v)) * unit_m;
  }
};

}  // namespace swiftlet
