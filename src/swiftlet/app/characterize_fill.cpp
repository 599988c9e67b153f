// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "swiftlet/app/characterize.hpp"
#include "swiftlet/app/experiment.hpp"
#include "swiftlet/app/text_output.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/base/angle.hpp"
#include "swiftlet/eval/fill.hpp"
#include "swiftlet/eval/wall_noise.hpp"
#include "swiftlet/source/depth_recording.hpp"

namespace swiftlet::app {
namespace {

/// The frames that share a setting.
struct FillMean {
  std::size_t frames = 0;
  double valid = 0.0, of_image = 0.0, of_middle = 0.0;  // sums

  void add(const eval::Fill& fill) {
    ++frames;
    valid += static_cast<double>(fill.valid);
    of_image += fill.of_image;
    of_middle += fill.of_middle;
  }
  [[nodiscard]] double mean(double sum) const { return sum / static_cast<double>(frames); }
};

/// Fill against one thing that was changed.
struct FillSweep {
  const char* name;   ///< of its files and in JSON
  const char* title;  ///< of its column, with the unit
  std::map<double, FillMean> by{};
};
struct FillSweeps {
  std::size_t frames = 0;
  FillSweep tilt{"tilt_deg", "tilt [deg]"};
  FillSweep exposure{"exposure_ms", "exposure [ms]"};
  FillSweep laser{"laser_mw", "laser power [mW]"};

  [[nodiscard]] std::vector<const FillSweep*> known() const {
    std::vector<const FillSweep*> sweeps;
    for (const FillSweep* sweep : {&tilt, &exposure, &laser}) {
      if (!sweep->by.empty()) sweeps.push_back(sweep);
    }
    return sweeps;
  }
};

double rounded(double value, double step) { return std::round(value / step) * step; }

void add_image(const DepthFrame& frame, const CaptureSettings& settings, FillSweeps& sweeps) {
  constexpr double kTiltStep_deg = 5.0, kExposureStep_ms = 0.1, kLaserStep_mw = 1.0;
  constexpr double kFlat = 0.05;  // RMS over distance; more is no wall, and has no tilt
  const eval::Fill fill = eval::measure_fill(frame.depth);
  ++sweeps.frames;
  const auto wall = eval::measure_wall(frame.depth, frame.intrinsics);
  if (wall && wall->rms_m < kFlat * wall->distance_m) {
    sweeps.tilt.by[rounded(degrees(wall->tilt_rad), kTiltStep_deg)].add(fill);
  }
  if (settings.exposure_us)
    sweeps.exposure.by[rounded(1e-3 * *settings.exposure_us, kExposureStep_ms)].add(fill);
  if (settings.laser_mw) sweeps.laser.by[rounded(*settings.laser_mw, kLaserStep_mw)].add(fill);
}

Status sweep(const std::string& address, FillSweeps& sweeps) {
  constexpr int kSmallest_px = 5;
  auto recording = open_depth_recording(address);
  if (!recording) return forward_error(std::move(recording));
  for (std::size_t i = 0;; ++i) {
    auto frame = recording->stream->next();
    if (!frame) return forward_error(std::move(frame));
    if (!*frame) return Done{};
    if (std::min((*frame)->depth.raw.width(), (*frame)->depth.raw.height()) < kSmallest_px)
      return fail(ErrorCode::kCorruptInput, address, "its images are smaller than 5 x 5 pixels");
    const bool is_told = i < recording->settings.size();
    add_image(**frame, is_told ? recording->settings[i] : CaptureSettings{}, sweeps);
  }
}

Figure figure_of(const FillSweep& sweep) {
  Figure figure{fmt::format("fill_{}", sweep.name),
                fmt::format("Valid pixels against {}", sweep.title), sweep.title,
                "valid pixels [%]"};
  Curve image{"of the image", {}, true}, middle{"of its middle fifth", {}, true};
  for (const auto& [value, fill] : sweep.by) {
    image.points.emplace_back(value, 100.0 * fill.mean(fill.of_image));
    middle.points.emplace_back(value, 100.0 * fill.mean(fill.of_middle));
  }
  figure.curves = {std::move(image), std::move(middle)};
  return figure;
}

Status draw(const FillSweeps& sweeps, const std::string& folder) {
  if (auto made = make_folder(folder); !made) return made;
  for (const FillSweep* sweep : sweeps.known()) {
    if (auto drawn = draw_figure(figure_of(*sweep), folder); !drawn)
      return forward_error(std::move(drawn));
  }
  return Done{};
}

nlohmann::ordered_json fill_json(const FillSweeps& sweeps) {
  nlohmann::ordered_json json{{"frames", sweeps.frames}};
  for (const FillSweep* sweep : sweeps.known()) {
    auto rows = nlohmann::ordered_json::array();
    for (const auto& [value, fill] : sweep->by) {
      rows.push_back({{sweep->name, value},
                      {"frames", fill.frames},
                      {"valid_pixels", fill.mean(fill.valid)},
                      {"of_image", fill.mean(fill.of_image)},
                      {"of_middle", fill.mean(fill.of_middle)}});
    }
    json[fmt::format("by_{}", sweep->name)] = std::move(rows);
  }
  return json;
}

void print_fill(const FillSweeps& sweeps) {
  fmt::print("{} frames\n", sweeps.frames);
  for (const FillSweep* sweep : sweeps.known()) {
    fmt::print("\n{:>16}  {:>6}  {:>12}  {:>12}  {:>13}\n", sweep->title, "frames", "valid pixels",
               "of the image", "of its middle");
    for (const auto& [value, fill] : sweep->by) {
      fmt::print("{:>16g}  {:>6}  {:>12.0f}  {:>10.1f} %  {:>11.1f} %\n", value, fill.frames,
                 fill.mean(fill.valid), 100.0 * fill.mean(fill.of_image),
                 100.0 * fill.mean(fill.of_middle));
    }
  }
  if (sweeps.exposure.by.empty() && sweeps.laser.by.empty())
    fmt::print("\nthe recording does not tell exposure and laser power\n");
}

}  // namespace

Faults characterize_fill(const CharacterizeOptions& options) {
  FillSweeps sweeps;
  for (const std::string& address : options.sources) {
    if (auto swept = sweep(address, sweeps); !swept) return fault_of(std::move(swept));
  }
  if (sweeps.frames == 0) {
    return {{ErrorCode::kCorruptInput, options.sources.front(), "it has no depth image",
             "record some"}};
  }
  if (!options.out.empty()) {
    if (auto drawn = draw(sweeps, options.out); !drawn) return fault_of(std::move(drawn));
  }
  if (options.as_json) {
    fmt::print("{}\n", json_text(fill_json(sweeps)));
  } else {
    print_fill(sweeps);
  }
  return {};
}

}  // namespace swiftlet::app
