// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/flight.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace swiftlet::sim {
namespace {

/// Slope at the middle one of three points, 0 at a turning point: the limiter of Fritsch and
/// Carlson with the weighted harmonic mean of Fritsch and Butland 1984.
double monotone_slope(double slope_before, double slope_after, double dt_before, double dt_after) {
  if (slope_before * slope_after <= 0.0) return 0.0;
  const double w_before = 2.0 * dt_after + dt_before;
  const double w_after = dt_after + 2.0 * dt_before;
  return (w_before + w_after) / (w_before / slope_before + w_after / slope_after);
}

std::vector<Eigen::Vector3d> monotone_velocities(const std::vector<Waypoint>& points) {
  std::vector<Eigen::Vector3d> velocities(points.size(), Eigen::Vector3d::Zero());
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double dt_before = points[i].time_s - points[i - 1].time_s;
    const double dt_after = points[i + 1].time_s - points[i].time_s;
    const Eigen::Vector3d before = (points[i].position_m - points[i - 1].position_m) / dt_before;
    const Eigen::Vector3d after = (points[i + 1].position_m - points[i].position_m) / dt_after;
    for (int axis = 0; axis < 3; ++axis)
      velocities[i][axis] = monotone_slope(before[axis], after[axis], dt_before, dt_after);
  }
  return velocities;
}

Eigen::Vector3d hermite(const Waypoint& a, const Waypoint& b, const Eigen::Vector3d& va,
                        const Eigen::Vector3d& vb, double s) {
  const double dt = b.time_s - a.time_s;
  const double s2 = s * s;
  const double s3 = s2 * s;
  return (2 * s3 - 3 * s2 + 1) * a.position_m + (s3 - 2 * s2 + s) * dt * va +
         (3 * s2 - 2 * s3) * b.position_m + (s3 - s2) * dt * vb;
}

/// Two sines of incommensurate periods; within [-1, 1].
double unrest(double t_s, double period_s, int axis) {
  const double phase = 2.0 * std::numbers::pi * t_s / period_s;
  return 0.7 * std::sin(phase + 2.1 * axis) +
         0.3 * std::sin(phase * std::numbers::sqrt2 * 1.3 + 1.7 * axis);
}

Transform<World, Flyer> swayed(const Transform<World, Flyer>& T, const Sway& sway, double t_s) {
  const auto angle = [&](int axis) { return sway.angle_rad * unrest(t_s, sway.period_s, axis); };
  const Eigen::Vector3d offset(unrest(t_s, sway.period_s, 3), unrest(t_s, sway.period_s, 4),
                               unrest(t_s, sway.period_s, 5));
  return Transform<World, Flyer>::trusted(
      (T.rotation() * rotation_from_ypr(angle(0), angle(1), angle(2))).normalized(),
      T.translation() + sway.position_m * offset);
}

}  // namespace

Eigen::Quaterniond rotation_from_ypr(double yaw_rad, double pitch_rad, double roll_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()) *
         Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitY()) *
         Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitX());
}

Expected<Flight> Flight::create(std::vector<Waypoint> waypoints, const Sway& sway) {
  if (waypoints.empty()) {
    return fail(ErrorCode::kInvalidConfig, "flight", "the flight has no waypoints",
                "give at least one: { at_m: [x, y, z] }");
  }
  const auto not_rising = [](const Waypoint& a, const Waypoint& b) { return b.time_s <= a.time_s; };
  if (std::ranges::adjacent_find(waypoints, not_rising) != waypoints.end()) {
    return fail(ErrorCode::kInvalidConfig, "flight", "the times of the waypoints do not rise");
  }
  if (!(waypoints.back().time_s - waypoints.front().time_s <= kLongest_s)) {
    return fail(ErrorCode::kInvalidConfig, "flight", "it would take more than a day",
                "fly faster or less far");
  }
  return Flight(std::move(waypoints), sway);
}

Flight::Flight(std::vector<Waypoint> waypoints, const Sway& sway)
    : waypoints_(std::move(waypoints)),
      velocities_mps_(monotone_velocities(waypoints_)),
      sway_(sway) {}

Nanoseconds Flight::duration() const {
  return Nanoseconds(std::llround((waypoints_.back().time_s - waypoints_.front().time_s) * 1e9));
}

Transform<World, Flyer> Flight::at(Nanoseconds since_start) const {
  const double first_s = waypoints_.front().time_s;
  const double t_s = std::clamp(first_s + seconds(since_start), first_s, waypoints_.back().time_s);
  const auto next = std::ranges::upper_bound(waypoints_, t_s, {}, &Waypoint::time_s);
  const auto i = static_cast<std::size_t>(std::max<std::ptrdiff_t>(
      0, std::min<std::ptrdiff_t>(next - waypoints_.begin(), std::ssize(waypoints_) - 1) - 1));

  const Waypoint& a = waypoints_[i];
  const Waypoint& b = waypoints_[std::min(i + 1, waypoints_.size() - 1)];
  const double span_s = b.time_s - a.time_s;
  const double s = span_s > 0.0 ? (t_s - a.time_s) / span_s : 0.0;
  const double eased = s * s * (3.0 - 2.0 * s);
  const auto& vb = velocities_mps_[std::min(i + 1, waypoints_.size() - 1)];
  const auto T = Transform<World, Flyer>::trusted(
      a.R_world_flyer.slerp(eased, b.R_world_flyer).normalized(),
      span_s > 0.0 ? hermite(a, b, velocities_mps_[i], vb, s) : a.position_m);
  return swayed(T, sway_, seconds(since_start));
}

Transform<World, Camera> Flight::camera_at(Nanoseconds since_start) const {
  const auto T_world_flyer = at(since_start);
  return Transform<World, Camera>::trusted(
      (T_world_flyer.rotation() * forward_looking_camera().rotation()).normalized(),
      T_world_flyer.translation());
}

}  // namespace swiftlet::sim
