// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

namespace swiftlet {

/// Depth noise of a stereo pair (or of a projector and a camera): it grows with the square of the
/// depth.
struct StereoNoise {
  double focal_px;    ///< f
  double baseline_m;  ///< B
  double subpixel_px =
      0.08;  ///< s: disparity error; 0.05 well textured, above 0.2 needs calibration

  /// Standard deviation of the depth [m] at depth z [m]: z^2 s / (f B).
  /// Source: method 3, eq. 3.5 with the square that Algorithm 3 has.
  [[nodiscard]] double sigma_m(double z_m) const {
    return z_m * z_m * subpixel_px / (focal_px * baseline_m);
  }
};

}  // namespace swiftlet
