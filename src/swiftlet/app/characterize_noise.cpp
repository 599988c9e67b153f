// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "swiftlet/app/characterize.hpp"
#include "swiftlet/app/experiment.hpp"
#include "swiftlet/app/text_output.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/eval/wall_noise.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"
#include "swiftlet/source/depth_recording.hpp"

namespace swiftlet::app {
namespace {

/// The walls of all frames, and the camera that saw them.
struct Walls {
  std::vector<eval::WallNoise> measured;
  double focal_px = 0.0;
  double baseline_m = 0.0;
};

Status measure(const std::string& address, Walls& walls) {
  auto recording = open_depth_recording(address);
  if (!recording) return forward_error(std::move(recording));
  const std::size_t before = walls.measured.size();
  for (;;) {
    auto frame = recording->stream->next();
    if (!frame) return forward_error(std::move(frame));
    if (!*frame) break;
    walls.focal_px = (*frame)->intrinsics.fx();
    walls.baseline_m = recording->baseline_m.value_or(SensorOptions{}.baseline_m);
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
  if (auto made = make_folder(folder); !made) return made;
  if (auto drawn = draw_figure(figure_of(walls, s_px), folder); !drawn)
    return forward_error(std::move(drawn));
  return write_text(
      std::filesystem::path(folder) / "sensor.yaml",
      fmt::format("sensor:\n  baseline_m: {}\n  subpixel_px: {:.4f}\n", walls.baseline_m, s_px));
}

}  // namespace

Faults characterize_noise(const CharacterizeOptions& options) {
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
    fmt::print("{}\n", json_text(json));
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

}  // namespace swiftlet::app
