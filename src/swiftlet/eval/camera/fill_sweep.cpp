// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/camera/fill_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "swiftlet/base/angle.hpp"
#include "swiftlet/eval/camera/depth_recording.hpp"
#include "swiftlet/eval/camera/wall_noise.hpp"

namespace swiftlet::eval {
namespace {

double rounded(double value, double step) { return std::round(value / step) * step; }

void add_image(const DepthFrame& frame, const CaptureSettings& settings, FillSweeps& sweeps) {
  constexpr double kTiltStep_deg = 5.0, kExposureStep_ms = 0.1, kLaserStep_mw = 1.0;
  constexpr double kFlat = 0.05;  // RMS over distance; more is no wall, and has no tilt
  const Fill fill = measure_fill(frame.depth);
  ++sweeps.frames;
  const auto wall = measure_wall(frame.depth, frame.intrinsics);
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

}  // namespace

Expected<FillSweeps> measure_fill_sweeps(std::span<const std::string> addresses) {
  FillSweeps sweeps;
  for (const std::string& address : addresses) {
    if (auto swept = sweep(address, sweeps); !swept) return forward_error(std::move(swept));
  }
  if (sweeps.frames > 0) return sweeps;
  return fail(ErrorCode::kCorruptInput, addresses.empty() ? "" : addresses.front(),
              "it has no depth image", "record some");
}

Figure fill_figure(const FillSweep& sweep) {
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

}  // namespace swiftlet::eval
