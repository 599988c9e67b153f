// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/depth_image.hpp"
#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/preprocess/depth_distortion.hpp"

namespace swiftlet::eval {

/// Depth images of a flat wall that a camera faces.
struct WallImages {
  std::vector<DepthImage> images;
  PinholeIntrinsics intrinsics;
};

struct DistortionFit {
  DepthDistortion distortion;
  double distance_m = 0.0;  ///< of the wall: as given, or the depth in the middle of the image
  double rms_m = 0.0;       ///< of the readings about the fit
  std::size_t readings = 0;
};

/// Fits the polynomial of DepthDistortion to a wall that the camera faces squarely, by least
/// squares (appendix A, eq. A.1); readings off by more than four deviations are left out. Without a
/// distance, the middle of the image is taken to be right: the offset is 0. A wall that is not
/// faced squarely looks like x1 and y1; tilt_rad() tells by how much. Errors: kCorruptInput with
/// fewer than 1000 readings or without readings all over the image.
[[nodiscard]] Expected<DistortionFit> fit_distortion(const WallImages& wall,
                                                     std::optional<double> distance_m);

/// The tilt of a wall that would look like the linear terms of a fit [rad].
[[nodiscard]] double tilt_rad(const DepthDistortion& distortion);

/// The images as the depth step `distortion` straightens them.
[[nodiscard]] WallImages straightened(const WallImages& wall, const DepthDistortion& distortion);

/// The largest mean error over a tile of the image, of 16 x 9 of them, as a share of the distance:
/// noise averages out, distortion does not. Tiles with fewer than 20 readings are left out.
[[nodiscard]] double worst_error(const WallImages& wall, double distance_m);

}  // namespace swiftlet::eval
