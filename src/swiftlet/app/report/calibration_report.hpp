// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "swiftlet/eval/camera/calibration.hpp"

namespace swiftlet::app {

/// "raw 11.5 %, self-calibrated 0.3 %"
[[nodiscard]] std::string calibration_text(const eval::CalibratedWall& wall);

/// Everything, for machines: the distortion of the first wall, and the errors of all.
[[nodiscard]] nlohmann::ordered_json calibration_json(std::span<const eval::CalibratedWall> walls);

/// Writes FOLDER/report.html and draws its figures; says on standard error if there is no gnuplot.
/// Errors: kIo.
[[nodiscard]] Status write_calibration_report(const std::string& folder,
                                              std::span<const eval::CalibratedWall> walls);

}  // namespace swiftlet::app
