// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <deque>
#include <optional>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/sim/vehicle/wind.hpp"

namespace swiftlet::sim {

/// What an autopilot in offboard mode takes (PX4's TrajectorySetpoint). [world]
///
/// With a position, the vehicle goes there; a velocity beside it is that of the place (feed
/// forward). With a velocity alone it flies so. With neither it stops where it can.
struct Setpoint {
  std::optional<Eigen::Vector3d> position_m{};
  std::optional<Eigen::Vector3d> velocity_mps{};
  std::optional<Eigen::Vector3d> acceleration_mps2{};  ///< feed forward, beside the others
  std::optional<double> yaw_rad{};                     ///< the shorter way round; else as it is
  std::optional<double> yaw_rate_radps{};              ///< feed forward, or alone
};

/// What a vehicle can do, and how well it is steered.
struct VehicleOptions {
  double max_speed_mps = 8.0;          ///< level
  double max_climb_mps = 3.0;          ///< up and down
  double max_acceleration_mps2 = 6.0;  ///< in any direction
  double max_jerk_mps3 = 40.0;         ///< likewise
  double max_yaw_rate_radps = 1.6;
  double max_yaw_acceleration_radps2 = 6.0;
  double position_gain_per_s = 1.5;          ///< metres away to metres a second
  double velocity_gain_per_s = 5.0;          ///< metres a second wrong to metres a second squared
  Nanoseconds command_latency{50'000'000};   ///< from command() until the vehicle obeys
  Nanoseconds command_timeout{500'000'000};  ///< without a new command it stops, as PX4 does
  bool tilts = true;  ///< leans into its acceleration, as a multirotor must, and the camera with it
  WindOptions wind{};
};

/// Where a vehicle is and how it moves. [world]
struct VehicleState {
  Stamp stamp{};
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  /// What the rotors give beyond hovering; with wind, the vehicle's own acceleration is another.
  Eigen::Vector3d thrust_mps2 = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;  ///< of the body's x axis, left is positive; not wrapped
  double yaw_rate_radps = 0.0;
  bool tilts = true;

  /// The body: x forward, y left, z along the thrust (or up, if it does not tilt).
  [[nodiscard]] Transform<World, Body> T_world_body() const;
};

/// A multirotor with its autopilot as a planner sees them: a point mass whose acceleration and jerk
/// are limited, which turns about the vertical, obeys late and is blown about.
///
/// A cascade as PX4's: position error to velocity, velocity error to acceleration, each limited,
/// the speed towards a place also by what can still be braked before it. Steps of 1 ms from time 0,
/// whatever the calls were: the same commands at the same times give the same flight to the bit.
class VehicleModel {
 public:
  static constexpr Nanoseconds kStep{1'000'000};

  /// `start.stamp` counts as the time of the first command: to stay there. Errors: kInvalidConfig
  /// if an option is not positive or not finite (latency and wind may be 0).
  [[nodiscard]] static Expected<VehicleModel> create(const VehicleOptions& options,
                                                     const VehicleState& start, std::uint64_t seed);

  /// Obeyed `command_latency` after `sent`, until another one is. Errors: kUsage for numbers that
  /// are not finite. REQUIRES: not sent before the one before, nor before state().stamp.
  [[nodiscard]] Status command(const Setpoint& setpoint, Stamp sent);

  /// Flies on to the last whole step before or at `until`.
  void advance(Stamp until);

  [[nodiscard]] const VehicleState& state() const { return state_; }
  [[nodiscard]] const VehicleOptions& options() const { return options_; }
  /// Whether it has stopped obeying because no command came for too long.
  [[nodiscard]] bool is_lost() const;

 private:
  struct Command {
    Stamp from;  // obeyed
    Setpoint setpoint;
  };
  VehicleModel(const VehicleOptions& options, const VehicleState& start, std::uint64_t seed);
  void step();
  [[nodiscard]] Eigen::Vector3d wanted_velocity(const Setpoint& setpoint) const;
  [[nodiscard]] Eigen::Vector3d fed_forward(const Setpoint& setpoint) const;
  [[nodiscard]] Eigen::Vector3d wanted_thrust(const Setpoint& setpoint, double dt_s);
  void turn(const Setpoint& setpoint, double dt_s);

  VehicleOptions options_;
  VehicleState state_;
  Wind wind_;
  Eigen::Vector3d against_wind_mps2_ = Eigen::Vector3d::Zero();  // what the autopilot has learnt
  std::deque<Command> commands_;  // the first is obeyed, the others are on their way
};

}  // namespace swiftlet::sim
