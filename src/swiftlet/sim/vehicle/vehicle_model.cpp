// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/vehicle/vehicle_model.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "swiftlet/base/contract.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;

constexpr double kGravity_mps2 = 9.81;
constexpr double kYawGain_per_s = 4.0;
constexpr double kWindGain_per_s2 = 2.0;  // how fast the autopilot learns what the wind does

Vector3d at_most(const Vector3d& v, double most) {
  const double length = v.norm();
  return length > most ? Vector3d(v * (most / length)) : v;
}

/// The shorter way from one heading to another.
double turned(double from_rad, double to_rad) {
  return std::remainder(to_rad - from_rad, 2.0 * std::numbers::pi);
}

/// The speed that is braked within a distance if braking sets in at a limited rate: the root of
/// v^2 / (2 a) + v a / (2 j) = d.
double brakeable(double distance, double deceleration, double jerk) {
  const double ramp = deceleration * deceleration / (2.0 * jerk);
  return std::sqrt(ramp * ramp + 2.0 * deceleration * distance) - ramp;
}

bool is_finite(const std::optional<Vector3d>& v) { return !v || v->allFinite(); }
bool is_finite(const std::optional<double>& x) { return !x || std::isfinite(*x); }

struct Checked {
  const char* name;
  double value;
};
Status check(const VehicleOptions& o) {
  const std::array positive{Checked{"max_speed_mps", o.max_speed_mps},
                            Checked{"max_climb_mps", o.max_climb_mps},
                            Checked{"max_acceleration_mps2", o.max_acceleration_mps2},
                            Checked{"max_jerk_mps3", o.max_jerk_mps3},
                            Checked{"max_yaw_rate_radps", o.max_yaw_rate_radps},
                            Checked{"max_yaw_acceleration_radps2", o.max_yaw_acceleration_radps2},
                            Checked{"position_gain_per_s", o.position_gain_per_s},
                            Checked{"velocity_gain_per_s", o.velocity_gain_per_s},
                            Checked{"command_timeout", seconds(o.command_timeout)},
                            Checked{"wind.gust_time_s", o.wind.gust_time_s}};
  for (const Checked& c : positive) {
    if (!(c.value > 0.0 && std::isfinite(c.value)))
      return fail(ErrorCode::kInvalidConfig, "vehicle",
                  std::string(c.name) + " must be a number above 0");
  }
  const bool is_wind = o.wind.mean_mps.allFinite() && o.wind.gust_mps >= 0.0 &&
                       std::isfinite(o.wind.gust_mps) && o.wind.drag_per_s >= 0.0 &&
                       std::isfinite(o.wind.drag_per_s);
  if (!is_wind || o.command_latency < Nanoseconds(0))
    return fail(ErrorCode::kInvalidConfig, "vehicle",
                "neither the wind nor the latency of commands may be negative or no number");
  return Done{};
}

}  // namespace

Transform<World, Body> VehicleState::T_world_body() const {
  const Vector3d up = tilts ? Vector3d(thrust_mps2 + kGravity_mps2 * Vector3d::UnitZ()).normalized()
                            : Vector3d(Vector3d::UnitZ());
  const Vector3d heading(std::cos(yaw_rad), std::sin(yaw_rad), 0.0);
  Eigen::Matrix3d R;
  R.col(2) = up;
  R.col(1) = up.cross(heading).normalized();
  R.col(0) = R.col(1).cross(up);
  return Transform<World, Body>::trusted(Eigen::Quaterniond(R).normalized(), position_m);
}

Expected<VehicleModel> VehicleModel::create(const VehicleOptions& options,
                                            const VehicleState& start, std::uint64_t seed) {
  if (auto sane = check(options); !sane) return forward_error(std::move(sane));
  if (!start.position_m.allFinite() || !start.velocity_mps.allFinite() ||
      !std::isfinite(start.yaw_rad))
    return fail(ErrorCode::kUsage, "vehicle", "its start is no place");
  return VehicleModel(options, start, seed);
}

VehicleModel::VehicleModel(const VehicleOptions& options, const VehicleState& start,
                           std::uint64_t seed)
    : options_(options), state_(start), wind_(options.wind, seed) {
  state_.tilts = options.tilts;
  commands_.push_back({start.stamp, {.position_m = start.position_m, .yaw_rad = start.yaw_rad}});
}

Status VehicleModel::command(const Setpoint& setpoint, Stamp sent) {
  SWIFTLET_REQUIRE(sent >= state_.stamp, "commands are sent now or later");
  const Stamp from = sent + options_.command_latency;
  SWIFTLET_REQUIRE(from >= commands_.back().from, "commands are sent in the order of time");
  if (!is_finite(setpoint.position_m) || !is_finite(setpoint.velocity_mps) ||
      !is_finite(setpoint.acceleration_mps2) || !is_finite(setpoint.yaw_rad) ||
      !is_finite(setpoint.yaw_rate_radps))
    return fail(ErrorCode::kUsage, "vehicle", "a setpoint is no number",
                "leave out what is unknown");
  commands_.push_back({from, setpoint});
  return Done{};
}

bool VehicleModel::is_lost() const {
  return state_.stamp - commands_.front().from > options_.command_timeout;
}

void VehicleModel::advance(Stamp until) {
  while (state_.stamp + kStep <= until) step();
}

void VehicleModel::step() {
  while (commands_.size() > 1 && commands_[1].from <= state_.stamp) commands_.pop_front();
  const Setpoint setpoint = is_lost() ? Setpoint{} : commands_.front().setpoint;
  const double dt_s = seconds(kStep);
  const Vector3d wanted = wanted_thrust(setpoint, dt_s);
  state_.thrust_mps2 += at_most(wanted - state_.thrust_mps2, options_.max_jerk_mps3 * dt_s);
  wind_.advance(dt_s);
  state_.velocity_mps += dt_s * (state_.thrust_mps2 + wind_.push_mps2(state_.velocity_mps));
  state_.position_m += dt_s * state_.velocity_mps;
  turn(setpoint, dt_s);
  state_.stamp = state_.stamp + kStep;
}

Vector3d VehicleModel::wanted_velocity(const Setpoint& setpoint) const {
  Vector3d wanted = setpoint.velocity_mps.value_or(Vector3d::Zero());
  if (setpoint.position_m) {
    const Vector3d way = *setpoint.position_m - state_.position_m;
    const double distance_m = way.norm();
    // Half of what it can: the rest corrects.
    const double speed = std::min(
        options_.position_gain_per_s * distance_m,
        brakeable(distance_m, 0.5 * options_.max_acceleration_mps2, options_.max_jerk_mps3));
    if (distance_m > 0.0) wanted += speed / distance_m * way;
  }
  const double level = wanted.head<2>().norm();
  if (level > options_.max_speed_mps) wanted *= options_.max_speed_mps / level;
  wanted.z() = std::clamp(wanted.z(), -options_.max_climb_mps, options_.max_climb_mps);
  return wanted;
}

/// Feed forward is not limited by a loop, so it must not drive beyond the limits of speed.
Vector3d VehicleModel::fed_forward(const Setpoint& setpoint) const {
  Vector3d ahead = at_most(setpoint.acceleration_mps2.value_or(Vector3d::Zero()),
                           options_.max_acceleration_mps2);
  const Eigen::Vector2d level = state_.velocity_mps.head<2>();
  const double faster = level.dot(ahead.head<2>());
  if (level.norm() >= options_.max_speed_mps && faster > 0.0)
    ahead.head<2>() -= faster / level.squaredNorm() * level;
  const double climb = state_.velocity_mps.z();
  if (std::abs(climb) >= options_.max_climb_mps && ahead.z() * climb > 0.0) ahead.z() = 0.0;
  return ahead;
}

Vector3d VehicleModel::wanted_thrust(const Setpoint& setpoint, double dt_s) {
  const Vector3d wrong_mps = wanted_velocity(setpoint) - state_.velocity_mps;
  const Vector3d wanted =
      options_.velocity_gain_per_s * wrong_mps + against_wind_mps2_ + fed_forward(setpoint);
  const Vector3d possible = at_most(wanted, options_.max_acceleration_mps2);
  // At its limits it learns nothing (anti-windup), in still air there is nothing to learn.
  if (options_.wind.blows() && possible == wanted) {
    against_wind_mps2_ = at_most(against_wind_mps2_ + kWindGain_per_s2 * dt_s * wrong_mps,
                                 0.5 * options_.max_acceleration_mps2);
  }
  return possible;
}

void VehicleModel::turn(const Setpoint& setpoint, double dt_s) {
  double wanted = setpoint.yaw_rate_radps.value_or(0.0);
  if (setpoint.yaw_rad) {
    const double way = turned(state_.yaw_rad, *setpoint.yaw_rad);
    const double rate = std::min(kYawGain_per_s * std::abs(way),
                                 std::sqrt(options_.max_yaw_acceleration_radps2 * std::abs(way)));
    wanted += std::copysign(rate, way);
  }
  wanted = std::clamp(wanted, -options_.max_yaw_rate_radps, options_.max_yaw_rate_radps);
  const double most = options_.max_yaw_acceleration_radps2 * dt_s;
  state_.yaw_rate_radps += std::clamp(wanted - state_.yaw_rate_radps, -most, most);
  state_.yaw_rad += dt_s * state_.yaw_rate_radps;
}

}  // namespace swiftlet::sim
