// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet::sim {

/// What moves along a Flight: x forward, y left, z up (the depth camera seen as a REP-103 body, or
/// a moving object).
struct Flyer {};

/// Rotation from angles as in REP-103: R = Rz(yaw) Ry(pitch) Rx(roll); yaw > 0 turns left, pitch >
/// 0 looks down, roll > 0 leans right.
[[nodiscard]] Eigen::Quaterniond rotation_from_ypr(double yaw_rad, double pitch_rad,
                                                   double roll_rad);

/// A place to be at a time.
struct Waypoint {
  double time_s = 0.0;  ///< since the start of the flight
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond R_world_flyer = Eigen::Quaterniond::Identity();
};

/// The unrest of a hand or of a hovering vehicle: two incommensurate sines per axis on top of the
/// path.
struct Sway {
  double position_m = 0.0;  ///< largest offset along each axis
  double angle_rad = 0.0;   ///< largest tilt about each axis
  double period_s = 2.0;    ///< of the slower sine
};

/// A smooth path through waypoints, known at every moment.
///
/// Position: monotone cubic Hermite (Fritsch and Carlson 1980) per axis, so C1-continuous and never
/// outside the box that two neighbouring waypoints span: a path that is planned between obstacles
/// does not swing into them. Attitude: SLERP (the shorter way round), eased so that the turn rate
/// is 0 at each waypoint. Before the first and after the last waypoint the flyer rests.
class Flight {
 public:
  /// Rests at the origin.
  Flight() : Flight({Waypoint{}}, Sway{}) {}
  static constexpr double kLongest_s = 86'400.0;
  /// Errors: kInvalidConfig unless there is a waypoint, the times rise, and all is over in a day.
  [[nodiscard]] static Expected<Flight> create(std::vector<Waypoint> waypoints,
                                               const Sway& sway = {});

  [[nodiscard]] Transform<World, Flyer> at(Nanoseconds since_start) const;
  /// The same path as that of a camera that looks along the flyer's x axis.
  [[nodiscard]] Transform<World, Camera> camera_at(Nanoseconds since_start) const;

  [[nodiscard]] Nanoseconds duration() const;
  [[nodiscard]] const std::vector<Waypoint>& waypoints() const { return waypoints_; }

 private:
  Flight(std::vector<Waypoint> waypoints, const Sway& sway);

  std::vector<Waypoint> waypoints_;
  std::vector<Eigen::Vector3d> velocities_mps_;  // at each waypoint
  Sway sway_;
};

}  // namespace swiftlet::sim
