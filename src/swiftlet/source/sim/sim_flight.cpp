// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/sim/sim_flight.hpp"

#if SWIFTLET_HAS_EMBREE

#include <fmt/format.h>

#include <numbers>
#include <utility>

#include "swiftlet/sim/scene_file.hpp"

namespace swiftlet {
namespace {

/// The scene's camera, and others like it, evenly around the body.
void place_cameras(const sim::Scene& scene, std::size_t count, RigOptions& rig) {
  const RigCamera first = rig.cameras.front();
  rig.cameras.clear();
  for (std::size_t i = 0; i < count; ++i) {
    const double yaw_rad =
        2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
    const auto turn = Transform<Body, Body>::trusted(sim::rotation_from_ypr(yaw_rad, 0.0, 0.0),
                                                     Eigen::Vector3d::Zero());
    RigCamera camera = first;
    camera.name = fmt::format("camera{}", i);
    camera.T_body_camera = i == 0 ? scene.T_body_camera : turn * scene.T_body_camera;
    rig.cameras.push_back(std::move(camera));
  }
}

struct SceneAndTask {
  sim::Scene scene;
  std::optional<sim::SceneTask> task;
};

/// The scene of a place: `random:KIND`, or what load_scene() finds.
Expected<SceneAndTask> open_scene(const std::string& place, const SimOptions& options) {
  constexpr std::string_view kRandom = "random:";
  if (place.starts_with(kRandom)) {
    auto drawn = sim::generate(std::string_view(place).substr(kRandom.size()),
                               options.seed.value_or(1), options.random);
    if (!drawn) return forward_error(std::move(drawn));
    return SceneAndTask{std::move(drawn->scene), std::move(drawn->task)};
  }
  if (!options.only_random.empty()) {
    return fail(ErrorCode::kUsage, "sim",
                fmt::format("only random scenes have the option '{}'", options.only_random),
                "leave it out, or fly sim:random:KIND");
  }
  auto scene = sim::load_scene(place);
  if (!scene) return forward_error(std::move(scene));
  return SceneAndTask{std::move(*scene), std::nullopt};
}

}  // namespace

Transform<World, Camera> SimFlight::true_pose(Stamp stamp, std::size_t camera) const {
  auto T_world_flown = scene.flight.camera_at(flown(stamp));
  if (camera == 0 && T_flown_camera.size() == 1) return T_world_flown;
  return T_world_flown * T_flown_camera[camera];
}

Expected<SimFlight> read_sim_flight(std::string_view rest) {
  auto address = parse_address(rest, "sim");
  if (!address) return forward_error(std::move(address));
  auto options = parse_sim_options(*address);
  if (!options) return forward_error(std::move(options));
  auto opened = open_scene(address->place, *options);
  if (!opened) return forward_error(std::move(opened));
  sim::Scene* const scene = &opened->scene;
  const Nanoseconds left = scene->flight.duration() - options->start;
  if (left < Nanoseconds(0)) {
    return fail(ErrorCode::kUsage, "sim", "start lies behind the end of the flight",
                fmt::format("the flight takes {:.1f} s", seconds(scene->flight.duration())));
  }
  scene->seed = options->seed.value_or(scene->seed);
  scene->camera.rate_hz = options->rate_hz.value_or(scene->camera.rate_hz);
  scene->camera.barrel = options->barrel.value_or(scene->camera.barrel);
  if (!options->has_noise) sim::make_ideal(scene->camera, scene->tracker);
  if (!options->has_drift)
    scene->tracker.drift_m_per_sqrt_s = scene->tracker.yaw_drift_rad_per_sqrt_s = 0.0;
  if (!options->rig_file) place_cameras(*scene, options->cameras, options->rig);
  SimFlight flight{std::move(opened->scene), std::move(*options), std::move(opened->task), {}};
  for (const RigCamera& camera : flight.options.rig.cameras)
    flight.T_flown_camera.push_back(flight.scene.T_body_camera.inverse() * camera.T_body_camera);
  return flight;
}

}  // namespace swiftlet

#endif  // SWIFTLET_HAS_EMBREE
