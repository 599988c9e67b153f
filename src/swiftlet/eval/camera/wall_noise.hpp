// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <span>

#include "swiftlet/frame/depth_image.hpp"
#include "swiftlet/frame/intrinsics.hpp"

namespace swiftlet::eval {

/// Depth noise on a flat wall.
struct WallNoise {
  double distance_m = 0.0;  ///< of the wall, along the optical axis
  double rms_m = 0.0;       ///< of the depths about the plane through them
  double tilt_rad = 0.0;    ///< of its normal against the optical axis
  std::size_t readings = 0;
};

/// Fits a plane to the readings of the central region of interest (the middle third of the image
/// along both axes) and tells how they scatter about it, along the optical axis (method 9).
/// nullopt with fewer than 100 readings. A wall may be tilted: 1 / z of a plane is linear in the
/// image, and so it is fitted.
[[nodiscard]] std::optional<WallNoise> measure_wall(const DepthImage& depth,
                                                    const PinholeIntrinsics& intrinsics);

/// The disparity error s [px] for which z^2 s / (f B) is nearest to what was measured, each wall
/// relative to its own. REQUIRES: walls not empty.
[[nodiscard]] double fit_subpixel_px(std::span<const WallNoise> walls, double focal_px,
                                     double baseline_m);

}  // namespace swiftlet::eval
