// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <utility>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/report/calibration_report.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/base/angle.hpp"
#include "swiftlet/base/number_text.hpp"
#include "swiftlet/file/output_file.hpp"
#include "swiftlet/file/text_output.hpp"
#include "swiftlet/source/address_options.hpp"

namespace swiftlet::app {
namespace {

using eval::CalibratedWall;

constexpr double kFarthest_m = 20.0;  // of a wall that says anything

struct CalibrateOptions {
  std::string what;
  std::string source;
  double distance_m = 0.0;          // 0: estimated
  std::vector<std::string> checks;  // source and distance, one after the other
  std::size_t frames = 30;
  std::string out;
  std::string report;
  bool as_json = false;
};

std::optional<double> distance_of(double distance_m) {
  return distance_m > 0.0 ? std::optional(distance_m) : std::nullopt;
}

/// The parameters as `swiftlet map --config` reads them.
std::string config_block(const CalibratedWall& wall) {
  const DepthDistortion& d = wall.self.distortion;
  return fmt::format(
      "# swiftlet calibrate distortion {}: wall at {:.4f} m, worst error {:.1f} % before, {:.2f} % "
      "after\n"
      "distortion:\n  x2_per_m: {:.7g}\n  y2_per_m: {:.7g}\n  x1: {:.7g}\n  y1: {:.7g}\n"
      "  offset_m: {:.7g}\n",
      wall.source, wall.distance_m, 100.0 * wall.raw_error, 100.0 * wall.self_error, d.x2_per_m,
      d.y2_per_m, d.x1, d.y1, d.offset_m);
}

void print_walls(std::span<const CalibratedWall> walls) {
  for (const CalibratedWall& wall : walls) {
    fmt::print(
        "{}: {} frames of a wall at {:.3f} m; mean error of the worst of 16 x 9 tiles:\n  {}\n",
        wall.source, wall.raw.images.size(), wall.distance_m, calibration_text(wall));
  }
  const double tilt_deg = degrees(eval::tilt_rad(walls.front().self.distortion));
  constexpr double kMostTilt_deg = 2.0;
  if (tilt_deg > kMostTilt_deg) {
    fmt::print(
        "a wall that is tilted by {:.1f} degrees looks like this, too: was it faced squarely?\n",
        tilt_deg);
  }
}

Error no_distance(const std::string& text) {
  return {ErrorCode::kUsage, "--check", fmt::format("'{}' is no distance", text),
          fmt::format("write --check SOURCE METRES, from 0 (as read) to {:g} m", kFarthest_m)};
}

/// Told before the recordings are read.
Status check_parameters_file(const CalibrateOptions& options) {
  if (options.out.empty()) return Done{};
  std::vector<std::filesystem::path> inputs = existing_files(options.source);
  for (const std::string& check : options.checks) {
    for (auto& file : existing_files(check)) inputs.push_back(std::move(file));
  }
  return check_output(options.out, inputs);
}

Faults calibrate(const CalibrateOptions& options) {
  if (auto allowed = check_parameters_file(options); !allowed) return fault_of(std::move(allowed));
  std::vector<CalibratedWall> walls;
  auto first =
      eval::calibrate_wall(options.source, distance_of(options.distance_m), options.frames);
  if (!first) return fault_of(std::move(first));
  walls.push_back(std::move(*first));
  const DepthDistortion found = walls.front().self.distortion;
  for (std::size_t i = 0; i + 1 < options.checks.size(); i += 2) {
    const auto distance_m = number_from<double>(options.checks[i + 1]);
    if (!distance_m || !(*distance_m >= 0.0) || *distance_m > kFarthest_m)
      return {no_distance(options.checks[i + 1])};
    auto wall =
        eval::calibrate_wall(options.checks[i], distance_of(*distance_m), options.frames, found);
    if (!wall) return fault_of(std::move(wall));
    walls.push_back(std::move(*wall));
  }
  const std::string block = config_block(walls.front());
  if (!options.out.empty()) {
    if (auto written = write_text(options.out, block); !written)
      return fault_of(std::move(written));
  }
  if (!options.report.empty()) {
    if (auto written = write_calibration_report(options.report, walls); !written)
      return fault_of(std::move(written));
  }
  if (options.as_json) {
    fmt::print("{}\n", json_text(calibration_json(walls)));
    return {};
  }
  print_walls(walls);
  if (options.out.empty()) fmt::print("{}", block);
  if (!options.report.empty())
    fmt::print("report: {}\n", (std::filesystem::path(options.report) / "report.html").string());
  return {};
}

}  // namespace

Action declare_calibrate(CLI::App& parser) {
  auto o = std::make_shared<CalibrateOptions>();
  CLI::Range metres(0.0, kFarthest_m), frames(1, 100);
  metres.description("");
  frames.description("");
  parser.add_option("WHAT", o->what, "distortion")
      ->type_name("")
      ->required()
      ->check(CLI::IsMember({"distortion"}));
  parser.add_option("SOURCE", o->source, "a recording that faces a flat wall; bags need no poses")
      ->type_name("")
      ->required();
  parser
      .add_option("--distance", o->distance_m,
                  "of the wall; not given: as read in the middle of the image")
      ->check(metres)
      ->type_name("METRES");
  parser
      .add_option("--check", o->checks,
                  "another wall and its distance (0: as read): what the calibration does there")
      ->type_size(2)
      ->type_name("SOURCE METRES");
  parser.add_option("--frames", o->frames, "images of each wall to use")
      ->check(frames)
      ->type_name("N")
      ->capture_default_str();
  parser.add_option("-o,--out", o->out, "file for the parameters, for --config")->type_name("FILE");
  parser.add_option("--report", o->report, "folder for report.html, .csv, .svg and .png")
      ->type_name("FOLDER");
  parser.add_flag("--json", o->as_json, "one JSON object, for machines");
  parser.footer(
      "Examples:\n"
      "  swiftlet calibrate distortion bag:wall.bag --distance 1.4 -o distortion.yaml\n"
      "  swiftlet map bag:flight.bag --config distortion.yaml\n"
      "  swiftlet calibrate distortion 'sim:calibration?barrel=0.1' --distance 1.4 --report bent\n"
      "Face a flat, textured wall squarely, so near that it fills the image. Where a flat wall "
      "comes\n"
      "out bent, the imagers do not stand as they should; the polynomial that straightens it "
      "grows\n"
      "with the square of the distance.");
  return [o] { return calibrate(*o); };
}

}  // namespace swiftlet::app
