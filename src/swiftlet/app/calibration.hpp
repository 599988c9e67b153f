// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "swiftlet/app/experiment.hpp"
#include "swiftlet/eval/distortion_fit.hpp"

namespace swiftlet::app {

/// One wall, as it is read and as it is after correction.
struct CalibratedWall {
  std::string source;
  double distance_m = 0.0;
  eval::DistortionFit self;            ///< fitted to this wall
  std::optional<DepthDistortion> pre;  ///< fitted to another one, before

  eval::WallImages raw;
  /// eval::worst_error() of the images raw, after `self`, and after `pre`.
  double raw_error = 0.0, self_error = 0.0;
  std::optional<double> pre_error{};
};

/// Reads a wall, fits it and judges it. Errors: those of the source and of fit_distortion().
[[nodiscard]] Expected<CalibratedWall> calibrate_wall(
    const std::string& source, std::optional<double> distance_m, std::size_t frames,
    const std::optional<DepthDistortion>& pre = std::nullopt);

/// The thesis's figures A.2 and A.3 of a wall: histogram of depth and top view, raw,
/// self-calibrated and pre-calibrated.
[[nodiscard]] std::vector<Figure> calibration_figures(const CalibratedWall& wall,
                                                      const std::string& name);

/// "raw 11.5 %, self-calibrated 0.3 %"
[[nodiscard]] std::string calibration_text(const CalibratedWall& wall);

/// Everything, for machines: the distortion of the first wall, and the errors of all.
[[nodiscard]] nlohmann::ordered_json calibration_json(std::span<const CalibratedWall> walls);

/// Writes FOLDER/report.html and draws its figures; says on standard error if there is no gnuplot.
/// Errors: kIo.
[[nodiscard]] Status write_calibration_report(const std::string& folder,
                                              std::span<const CalibratedWall> walls);

}  // namespace swiftlet::app
