// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <cmath>

#include "swiftlet/eval/thesis/experiment.hpp"

#if SWIFTLET_HAS_EMBREE

#include "swiftlet/eval/camera/wall_noise.hpp"
#include "swiftlet/sensor/stereo_noise.hpp"
#include "swiftlet/sim/stereo_camera.hpp"

namespace swiftlet::eval {

Expected<ExperimentResult> run_noise(const ProgressFunction& progress);

namespace {

constexpr double kSubpixel_px = 0.08;  // of the simulated camera

Expected<std::vector<WallNoise>> measure_walls(const sim::StereoOptions& options) {
  std::vector<WallNoise> walls;
  auto camera = sim::StereoCamera::create(options, 5);
  if (!camera) return forward_error(std::move(camera));
  const auto T_world_camera = Transform<World, Body>{} * forward_looking_camera();
  for (const double distance_m : {1.0, 2.0, 3.0, 4.0, 6.0, 8.0}) {
    sim::Scene scene;
    scene.objects = {{"wall", sim::Plane{{distance_m, 0, 0}, {-1, 0, 0}}}};
    const auto world = sim::RayCaster::create(scene);
    if (!world) return tl::make_unexpected(world.error());
    const DepthImage image = camera->capture(*world, T_world_camera, walls.size());
    if (const auto wall = measure_wall(image, camera->intrinsics())) walls.push_back(*wall);
  }
  return walls;
}

}  // namespace

/// Walls from 1 to 8 m before the simulated D435: the RMS of a plane fit in the central region of
/// interest, beside z^2 s / (f B) for several s.
Expected<ExperimentResult> run_noise(const ProgressFunction& /*progress*/) {
  sim::StereoOptions options;
  options.disparity_noise_px = kSubpixel_px;
  const auto walls = measure_walls(options);
  if (!walls) return tl::make_unexpected(walls.error());
  const double focal_px = 0.5 * options.width / std::tan(0.5 * options.hfov_rad);
  const double s_px = fit_subpixel_px(*walls, focal_px, options.baseline_m);
  ExperimentResult result;
  Figure figure{"noise", "RMS error on a wall: theory and test", "distance [m]", "RMS [m]"};
  for (const double s : {0.04, 0.08, 0.2}) {
    const StereoNoise theory{focal_px, options.baseline_m, s};
    Curve curve{fmt::format("theory, s = {} px", s), {}, false};
    for (double z_m = 0.5; z_m <= 8.0; z_m += 0.1)
      curve.points.emplace_back(z_m, theory.sigma_m(z_m));
    figure.curves.push_back(std::move(curve));
  }
  Curve test{"test", {}, true};
  for (const WallNoise& wall : *walls) test.points.emplace_back(wall.distance_m, wall.rms_m);
  figure.curves.push_back(std::move(test));
  result.figures = {std::move(figure)};
  result.checks = {{"disparity error s from the walls",
                    fmt::format("{} px, within 5 %", kSubpixel_px), fmt::format("{:.4f} px", s_px),
                    std::abs(s_px / kSubpixel_px - 1.0) <= 0.05}};
  const StereoNoise theory{focal_px, options.baseline_m, kSubpixel_px};
  double worst = 0.0;
  for (const WallNoise& wall : *walls)
    worst = std::max(worst, std::abs(wall.rms_m / theory.sigma_m(wall.distance_m) - 1.0));
  result.checks.push_back({"RMS error at 1 to 8 m", "grows with z^2: within 10 % of theory",
                           fmt::format("{:.1f} % off at most", 100.0 * worst), worst <= 0.1});
  return result;
}

}  // namespace swiftlet::eval

#else

namespace swiftlet::eval {

Expected<ExperimentResult> run_noise(const ProgressFunction& progress);

Expected<ExperimentResult> run_noise(const ProgressFunction& /*progress*/) {
  return fail(ErrorCode::kUnsupported, "noise", "this build of Swiftlet has no simulated rig",
              "configure with -DSWIFTLET_WITH_EMBREE=ON");
}

}  // namespace swiftlet::eval

#endif
