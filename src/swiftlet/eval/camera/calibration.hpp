// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "swiftlet/eval/camera/distortion_fit.hpp"
#include "swiftlet/eval/figure.hpp"

namespace swiftlet::eval {

/// One wall, as it is read and as it is after correction.
struct CalibratedWall {
  std::string source;                  ///< address of the recording
  double distance_m = 0.0;             ///< mean distance of the wall
  DistortionFit self;                  ///< fitted to this wall
  std::optional<DepthDistortion> pre;  ///< fitted to another one, before

  WallImages raw;  ///< what was read
  /// worst_error() of the images raw, after `self`, and after `pre`.
  double raw_error = 0.0, self_error = 0.0;  ///< [m], before and after the fit's own correction
  std::optional<double> pre_error{};         ///< with a correction that was given
};

/// Reads a wall, fits it and judges it. Errors: those of the source and of fit_distortion().
[[nodiscard]] Expected<CalibratedWall> calibrate_wall(
    const std::string& source, std::optional<double> distance_m, std::size_t frames,
    const std::optional<DepthDistortion>& pre = std::nullopt);

/// The thesis's figures A.2 and A.3 of a wall: histogram of depth and top view, raw,
/// self-calibrated and pre-calibrated.
[[nodiscard]] std::vector<Figure> calibration_figures(const CalibratedWall& wall,
                                                      const std::string& name);

}  // namespace swiftlet::eval
