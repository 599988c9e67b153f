// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

namespace swiftlet {

/// How far off the depths of a camera are, whose two imagers do not stand as they should (method 9,
/// appendix A): a flat wall comes out bent like a barrel.
///
///   Z = Z_m - (x2 X^2 + y2 Y^2 + x1 X + y1 Y + offset)
///
/// with X, Y, Z_m [m, camera] the point that was read. The thesis has the terms in X alone; a
/// barrel has those in Y, too. X is the pixel's slope times Z_m, so the correction grows with the
/// square of the depth, as an error of disparity does. `swiftlet calibrate distortion` finds the
/// numbers.
struct DepthDistortion {
  double x2_per_m = 0.0, y2_per_m = 0.0;
  double x1 = 0.0, y1 = 0.0;
  double offset_m = 0.0;

  [[nodiscard]] bool is_none() const { return *this == DepthDistortion{}; }
  friend bool operator==(const DepthDistortion&, const DepthDistortion&) = default;
};

}  // namespace swiftlet
