// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/report/calibration_report.hpp"

#include <fmt/format.h>

#include <utility>

#include "swiftlet/app/report/experiment_report.hpp"
#include "swiftlet/file/text_output.hpp"

namespace swiftlet::app {
namespace {

using eval::CalibratedWall;
using eval::ExperimentResult;
using eval::ExperimentRun;

ExperimentRun run_of(const CalibratedWall& wall) {
  const std::string name = fmt::format("wall_{:.2f}m", wall.distance_m);
  ExperimentResult result;
  // A calibration is for the distance that it was made at; elsewhere it must help.
  const bool is_passed =
      wall.pre_error ? *wall.pre_error < 0.5 * wall.raw_error : wall.self_error < 0.01;
  result.checks = {{"mean error of the worst of 16 x 9 tiles",
                    wall.pre_error ? "pre-calibrated at most half of raw" : "calibrated below 1 %",
                    calibration_text(wall), is_passed}};
  result.figures = eval::calibration_figures(wall, name);
  return {name, wall.source, std::move(result), 0.0};
}

}  // namespace

std::string calibration_text(const CalibratedWall& wall) {
  std::string text = fmt::format("raw {:.2f} %, self-calibrated {:.2f} %", 100.0 * wall.raw_error,
                                 100.0 * wall.self_error);
  if (wall.pre_error) text += fmt::format(", pre-calibrated {:.2f} %", 100.0 * *wall.pre_error);
  return text;
}

Status write_calibration_report(const std::string& folder, std::span<const CalibratedWall> walls) {
  if (auto made = make_folder(folder); !made) return made;
  std::vector<ExperimentRun> runs;
  for (const CalibratedWall& wall : walls) runs.push_back(run_of(wall));
  return write_report(runs, folder, {"Depth distortion", "walls are as flat as expected", "wall"});
}

nlohmann::ordered_json calibration_json(std::span<const CalibratedWall> walls) {
  const DepthDistortion& d = walls.front().self.distortion;
  nlohmann::ordered_json json{{"distortion",
                               {{"x2_per_m", d.x2_per_m},
                                {"y2_per_m", d.y2_per_m},
                                {"x1", d.x1},
                                {"y1", d.y1},
                                {"offset_m", d.offset_m}}}};
  auto list = nlohmann::ordered_json::array();
  for (const CalibratedWall& wall : walls) {
    nlohmann::ordered_json entry{{"source", wall.source},
                                 {"distance_m", wall.distance_m},
                                 {"frames", wall.raw.images.size()},
                                 {"error_raw", wall.raw_error},
                                 {"error_self_calibrated", wall.self_error}};
    if (wall.pre_error) entry["error_pre_calibrated"] = *wall.pre_error;
    list.push_back(std::move(entry));
  }
  json["walls"] = std::move(list);
  return json;
}

}  // namespace swiftlet::app
