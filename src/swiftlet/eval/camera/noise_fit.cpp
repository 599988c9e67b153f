// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/camera/noise_fit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "swiftlet/eval/camera/depth_recording.hpp"
#include "swiftlet/sensor/stereo_sensor.hpp"

namespace swiftlet::eval {
namespace {

Status measure(const std::string& address, NoiseFit& fit) {
  auto recording = open_depth_recording(address);
  if (!recording) return forward_error(std::move(recording));
  const std::size_t before = fit.walls.size();
  for (;;) {
    auto frame = recording->stream->next();
    if (!frame) return forward_error(std::move(frame));
    if (!*frame) break;
    fit.focal_px = (*frame)->intrinsics.fx();
    fit.baseline_m = recording->baseline_m.value_or(SensorOptions{}.baseline_m);
    if (const auto wall = measure_wall((*frame)->depth, (*frame)->intrinsics))
      fit.walls.push_back(*wall);
  }
  if (fit.walls.size() > before) return Done{};
  return fail(ErrorCode::kCorruptInput, address, "no frame shows a wall in the middle of the image",
              "face a flat wall; the middle third needs 100 readings");
}

}  // namespace

Expected<NoiseFit> fit_noise(std::span<const std::string> addresses) {
  NoiseFit fit;
  for (const std::string& address : addresses) {
    if (auto measured = measure(address, fit); !measured) return forward_error(std::move(measured));
  }
  fit.subpixel_px = fit_subpixel_px(fit.walls, fit.focal_px, fit.baseline_m);
  return fit;
}

Figure noise_figure(const NoiseFit& fit) {
  Figure figure{"noise", "RMS error on a wall: theory and test", "distance [m]", "RMS [m]"};
  double farthest_m = 0.0;
  Curve test{"test", {}, true};
  for (const WallNoise& wall : fit.walls) {
    test.points.emplace_back(wall.distance_m, wall.rms_m);
    farthest_m = std::max(farthest_m, wall.distance_m);
  }
  const StereoNoise theory{fit.focal_px, fit.baseline_m, fit.subpixel_px};
  Curve curve{fmt::format("theory, s = {:.3f} px", fit.subpixel_px), {}, false};
  for (int i = 1; i <= 100; ++i) {
    const double z_m = 0.011 * i * farthest_m;
    curve.points.emplace_back(z_m, theory.sigma_m(z_m));
  }
  figure.curves = {std::move(curve), std::move(test)};
  return figure;
}

}  // namespace swiftlet::eval
