// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "swiftlet/app/commands/characterize.hpp"
#include "swiftlet/app/report/experiment_report.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/eval/camera/noise_fit.hpp"
#include "swiftlet/file/text_output.hpp"

namespace swiftlet::app {
namespace {

/// The figure, its numbers, and the parameter as `swiftlet map --config` reads it.
Status write_results(const std::string& folder, const eval::NoiseFit& fit) {
  if (auto made = make_folder(folder); !made) return made;
  if (auto drawn = draw_figure(eval::noise_figure(fit), folder); !drawn)
    return forward_error(std::move(drawn));
  return write_text(std::filesystem::path(folder) / "sensor.yaml",
                    fmt::format("sensor:\n  baseline_m: {}\n  subpixel_px: {:.4f}\n",
                                fit.baseline_m, fit.subpixel_px));
}

}  // namespace

Faults characterize_noise(const CharacterizeOptions& options) {
  const auto fit = eval::fit_noise(options.sources);
  if (!fit) return {fit.error()};
  if (!options.out.empty()) {
    if (auto written = write_results(options.out, *fit); !written)
      return fault_of(std::move(written));
  }
  if (options.as_json) {
    auto list = nlohmann::ordered_json::array();
    for (const eval::WallNoise& wall : fit->walls)
      list.push_back({{"distance_m", wall.distance_m}, {"rms_m", wall.rms_m}});
    const nlohmann::ordered_json json{{"subpixel_px", fit->subpixel_px},
                                      {"walls", std::move(list)}};
    fmt::print("{}\n", json_text(json));
    return {};
  }
  fmt::print("{} walls, f = {:.1f} px, B = {} m\n", fit->walls.size(), fit->focal_px,
             fit->baseline_m);
  for (std::size_t i = 0; i < fit->walls.size(); i += 1 + fit->walls.size() / 20) {
    const eval::WallNoise& wall = fit->walls[i];
    fmt::print("  {:.3f} m: RMS {:.2f} mm\n", wall.distance_m, 1e3 * wall.rms_m);
  }
  fmt::print("disparity error s = {:.4f} px: --set sensor.subpixel_px={:.4f}\n", fit->subpixel_px,
             fit->subpixel_px);
  return {};
}

}  // namespace swiftlet::app
