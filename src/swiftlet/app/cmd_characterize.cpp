// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/experiment.hpp"
#include "swiftlet/eval/wall_noise.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::app {
namespace {

struct CharacterizeOptions {
  std::string what;
  std::vector<std::string> sources;
  std::string out;
  bool as_json = false;
};

/// The walls of all frames, and the camera that saw them.
struct Walls {
  std::vector<eval::WallNoise> measured;
  double focal_px = 0.0;
  double baseline_m = 0.0;
};

Status measure(const std::string& address, Walls& walls) {
  auto source = open_source(address);
  if (!source) return forward_error(std::move(source));
  const std::size_t before = walls.measured.size();
  const double baseline_m = (*source)->info().baseline_m.value_or(SensorOptions{}.baseline_m);
  for (;;) {
    auto frame = (*source)->next();
    if (!frame) return forward_error(std::move(frame));
    if (!*frame) break;
    walls.focal_px = (*frame)->intrinsics.fx();
    walls.baseline_m = (*frame)->baseline_m > 0.0 ? (*frame)->baseline_m : baseline_m;
    if (const auto wall = eval::measure_wall((*frame)->depth, (*frame)->intrinsics))
      walls.measured.push_back(*wall);
  }
  if (walls.measured.size() > before) return Done{};
  return fail(ErrorCode::kCorruptInput, address, "no frame shows a wall in the middle of the image",
              "face a flat wall; the middle third needs 100 readings");
}

Figure figure_of(const Walls& walls, double s_px) {
  Figure figure{"noise", "RMS error on a wall: theory and test", "distance [m]", "RMS [m]"};
  double farthest_m = 0.0;
  Curve test{"test", {}, true};
  for (const eval::WallNoise& wall : walls.measured) {
    test.points.emplace_back(wall.distance_m, wall.rms_m);
    farthest_m = std::max(farthest_m, wall.distance_m);
  }
  const StereoNoise theory{walls.focal_px, walls.baseline_m, s_px};
  Curve curve{fmt::format("theory, s = {:.3f} px", s_px), {}, false};
  for (int i = 1; i <= 100; ++i) {
    const double z_m = 0.011 * i * farthest_m;
    curve.points.emplace_back(z_m, theory.sigma_m(z_m));
  }
  figure.curves = {std::move(curve), std::move(test)};
  return figure;
}

/// The figure, its numbers, and the parameter as `swiftlet map --config` reads it.
Status write_results(const std::string& folder, const Walls& walls, double s_px) {
  std::error_code refused;
  std::filesystem::create_directories(folder, refused);
  if (refused) return fail(ErrorCode::kIo, folder, "the folder cannot be made");
  const auto drawn = draw_figure(figure_of(walls, s_px), folder);
  if (!drawn) return tl::make_unexpected(drawn.error());
  const std::string path = (std::filesystem::path(folder) / "sensor.yaml").string();
  std::ofstream file(path);
  file << fmt::format("sensor:\n  baseline_m: {}\n  subpixel_px: {:.4f}\n", walls.baseline_m, s_px);
  file.flush();
  if (file) return Done{};
  return fail(ErrorCode::kIo, path, "the file cannot be written");
}

Faults characterize(const CharacterizeOptions& options) {
  Walls walls;
  for (const std::string& address : options.sources) {
    if (auto measured = measure(address, walls); !measured) return fault_of(std::move(measured));
  }
  const double s_px = eval::fit_subpixel_px(walls.measured, walls.focal_px, walls.baseline_m);
  if (!options.out.empty()) {
    if (auto written = write_results(options.out, walls, s_px); !written)
      return fault_of(std::move(written));
  }
  if (options.as_json) {
    auto list = nlohmann::ordered_json::array();
    for (const eval::WallNoise& wall : walls.measured)
      list.push_back({{"distance_m", wall.distance_m}, {"rms_m", wall.rms_m}});
    const nlohmann::ordered_json json{{"subpixel_px", s_px}, {"walls", std::move(list)}};
    fmt::print("{}\n", json.dump(2));
    return {};
  }
  fmt::print("{} walls, f = {:.1f} px, B = {} m\n", walls.measured.size(), walls.focal_px,
             walls.baseline_m);
  for (std::size_t i = 0; i < walls.measured.size(); i += 1 + walls.measured.size() / 20) {
    const eval::WallNoise& wall = walls.measured[i];
    fmt::print("  {:.3f} m: RMS {:.2f} mm\n", wall.distance_m, 1e3 * wall.rms_m);
  }
  fmt::print("disparity error s = {:.4f} px: --set sensor.subpixel_px={:.4f}\n", s_px, s_px);
  return {};
}

}  // namespace

Action declare_characterize(CLI::App& parser) {
  auto o = std::make_shared<CharacterizeOptions>();
  parser.add_option("WHAT", o->what, "noise")
      ->type_name("")
      ->required()
      ->check(CLI::IsMember({"noise"}));
  parser.add_option("SOURCES", o->sources, "recordings of a flat wall, at one or more distances")
      ->type_name("")
      ->required();
  parser.add_option("-o,--out", o->out, "folder for sensor.yaml, noise.csv and noise.svg")
      ->type_name("FOLDER");
  parser.add_flag("--json", o->as_json, "one JSON object, for machines");
  parser.footer(
      "Examples:\n"
      "  swiftlet characterize noise bag:wall_1m.bag bag:wall_4m.bag -o d435\n"
      "  swiftlet map bag:flight.bag --config d435/sensor.yaml\n"
      "Fits a plane to the middle third of every image and the disparity error s to how the\n"
      "readings scatter about it: RMS = z^2 s / (f B).");
  return [o] { return characterize(*o); };
}

}  // namespace swiftlet::app
