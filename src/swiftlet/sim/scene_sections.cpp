// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <cmath>

#include "swiftlet/sim/scene_sections_private.hpp"

namespace swiftlet::sim {
namespace {

double angle(YamlSection& section, std::string_view key_deg, double fallback_rad = 0.0) {
  return radians(section.number(key_deg, kAnyNumber, fallback_rad / radians(1.0)));
}

Eigen::Quaterniond attitude(YamlSection& section) {
  const double yaw = angle(section, "yaw_deg");
  const double pitch = angle(section, "pitch_deg");
  return rotation_from_ypr(yaw, pitch, angle(section, "roll_deg"));
}

std::optional<TrackerOptions::Jump> read_jump(YamlSection& tracker) {
  auto section = tracker.section("jump");
  if (!section) return std::nullopt;
  TrackerOptions::Jump jump;
  jump.at_s = section->number("at_s", kNotNegative);
  jump.by_m = section->vector("by_m", Eigen::Vector3d::Zero());
  jump.yaw_rad = angle(*section, "yaw_deg");
  section->finish();
  return jump;
}

Sway read_sway(YamlSection& flight) {
  auto section = flight.section("sway");
  Sway sway;
  if (!section) return sway;
  sway.position_m = section->number("position_m", {0.0, 1e6}, 0.0);
  sway.angle_rad = radians(section->number("angle_deg", kNotNegative, 0.0));
  sway.period_s = section->number("period_s", kPositive, sway.period_s);
  section->finish();
  return sway;
}

/// How fast legs go that do not state their own duration.
struct Pace {
  double speed_mps;
  double turn_radps;

  [[nodiscard]] double leg_s(const Waypoint& a, const Waypoint& b) const {
    constexpr double kShortestLeg_s = 0.2;
    return std::max({kShortestLeg_s, (b.position_m - a.position_m).norm() / speed_mps,
                     a.R_world_flyer.angularDistance(b.R_world_flyer) / turn_radps});
  }
};

std::vector<Waypoint> read_waypoints(YamlSection& flight, const Pace& pace) {
  std::vector<Waypoint> waypoints;
  for (YamlSection& entry : flight.list("waypoints")) {
    Waypoint next{0.0, entry.vector("at_m"), attitude(entry)};
    if (!waypoints.empty()) {
      const Waypoint& last = waypoints.back();
      next.time_s = last.time_s + entry.number("leg_s", kPositive, pace.leg_s(last, next));
    }
    waypoints.push_back(next);
    entry.finish();
  }
  return waypoints;
}

}  // namespace

void read_camera(YamlSection& scene, StereoOptions& camera) {
  auto section = scene.section("camera");
  if (!section) return;
  constexpr Limits kSide{1.0, 4096.0}, kBarrel{-0.5, 0.5};
  const StereoOptions d435 = camera;
  camera.width = static_cast<int>(section->number("width_px", kSide, d435.width));
  camera.height = static_cast<int>(section->number("height_px", kSide, d435.height));
  camera.hfov_rad =
      radians(section->number("hfov_deg", {1.0, 170.0}, d435.hfov_rad / radians(1.0)));
  camera.baseline_m = section->number("baseline_m", kPositive, d435.baseline_m);
  camera.rate_hz = section->number("rate_hz", {0.1, 1000.0}, d435.rate_hz);
  camera.min_range_m = section->number("min_range_m", kPositive, d435.min_range_m);
  camera.max_range_m = section->number("max_range_m", {d435.min_range_m, 65.0}, d435.max_range_m);
  camera.disparity_noise_px =
      section->number("disparity_noise_px", kNotNegative, d435.disparity_noise_px);
  camera.disparity_step_px =
      section->number("disparity_step_px", kPositive, d435.disparity_step_px);
  camera.mixed_pixel_chance =
      section->number("mixed_pixel_chance", kFraction, d435.mixed_pixel_chance);
  camera.barrel = section->number("barrel", kBarrel, d435.barrel);
  section->finish();
}

void read_mount(YamlSection& scene, Transform<Body, Camera>& T_body_camera) {
  auto section = scene.section("mount");
  if (!section) return;
  T_body_camera = mount_from(section->vector("at_m"), attitude(*section));
  section->finish();
}

void read_tracker(YamlSection& scene, TrackerOptions& tracker) {
  auto section = scene.section("tracker");
  if (!section) return;
  const TrackerOptions t265 = tracker;
  const auto not_negative = [&](std::string_view key, double fallback) {
    return section->number(key, kNotNegative, fallback);
  };
  const double in_degrees = 1.0 / radians(1.0);
  tracker.rate_hz = section->number("rate_hz", {1.0, 10000.0}, t265.rate_hz);
  tracker.position_noise_m = not_negative("position_noise_m", t265.position_noise_m);
  tracker.attitude_noise_rad =
      radians(not_negative("attitude_noise_deg", t265.attitude_noise_rad * in_degrees));
  tracker.drift_m_per_sqrt_s = not_negative("drift_m_per_sqrt_s", t265.drift_m_per_sqrt_s);
  tracker.yaw_drift_rad_per_sqrt_s =
      radians(not_negative("yaw_drift_deg_per_sqrt_s", t265.yaw_drift_rad_per_sqrt_s * in_degrees));
  tracker.medium_after_s = not_negative("medium_after_s", t265.medium_after_s);
  tracker.high_after_s = not_negative("high_after_s", t265.high_after_s);
  tracker.nan_chance = section->number("nan_chance", kFraction, t265.nan_chance);
  tracker.jump = read_jump(*section);
  section->finish();
}

void read_materials(YamlSection& scene, std::vector<Material>& materials) {
  for (auto& [name, section] : scene.named("materials")) {
    materials.push_back({name, section.number("texture", kFraction)});
    section.finish();
  }
}

Flight read_flight(YamlSection& parent, std::string_view key) {
  auto section = parent.section(key);
  if (!section) {
    parent.problem("the " + std::string(key) + " is missing",
                   "add '" + std::string(key) + ": { waypoints: [ { at_m: [x, y, z] } ] }'");
    return {};
  }
  const Pace pace{section->number("speed_mps", kPositive, 0.7),
                  radians(section->number("turn_deg_per_s", kPositive, 45.0))};
  const Sway sway = read_sway(*section);
  auto flight = Flight::create(read_waypoints(*section, pace), sway);
  section->finish();
  if (flight) return *std::move(flight);
  section->problem(flight.error().what, flight.error().remedy);
  return {};
}

}  // namespace swiftlet::sim
