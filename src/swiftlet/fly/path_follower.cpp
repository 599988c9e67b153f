// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/fly/path_follower.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {
namespace {

constexpr double kCreep_mps = 0.4;    // the last of a path is flown so, to its very end
constexpr double kBrakeHarder = 1.6;  // than planned, where the path was cut short
constexpr double kBendReach_m = 0.4;  // over which the direction is compared

double angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

PathFollower::PathFollower(const FollowLimits& limits, const Eigen::Vector3d& place)
    : limits_(limits) {
  follow({place});
}

void PathFollower::follow(std::vector<Eigen::Vector3d> points) {
  points_.clear();
  along_m_.clear();
  for (const Eigen::Vector3d& p : points) {
    const double step_m = points_.empty() ? 0.0 : (p - points_.back()).norm();
    if (!points_.empty() && step_m < 1e-6) continue;
    along_m_.push_back(points_.empty() ? 0.0 : along_m_.back() + step_m);
    points_.push_back(p);
  }
  path_m_ = 0.0;
  set_limits();
}

/// In bends by their radius: the direction half a reach behind against that half a reach ahead.
void PathFollower::set_limits() {
  speed_at_.assign(points_.size(), limits_.max_speed_mps);
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
    const double reach_m = std::min({kBendReach_m, along_m_[i], end_m() - along_m_[i]});
    const Eigen::Vector3d before = points_[i] - place_at(along_m_[i] - reach_m);
    const Eigen::Vector3d after = place_at(along_m_[i] + reach_m) - points_[i];
    const double radius_m = reach_m / std::max(angle_between(before, after), 1e-6);
    speed_at_[i] =
        std::min(limits_.max_speed_mps, std::sqrt(limits_.max_acceleration_mps2 * radius_m));
  }
  speed_at_.back() = 0.0;
}

void PathFollower::stop_at(double path_m) {
  const double end = std::clamp(path_m, path_m_, end_m());
  const double speed_mps = speed_mps_;
  follow(piece(path_m_, end));
  speed_mps_ = speed_mps;
}

std::size_t PathFollower::leg_at(double path_m) const {
  const auto behind = std::upper_bound(along_m_.begin(), along_m_.end(), path_m);
  const auto leg = behind - along_m_.begin() - 1;
  return static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(leg, 0, std::max<std::ptrdiff_t>(std::ssize(points_) - 2, 0)));
}

Eigen::Vector3d PathFollower::place_at(double path_m) const {
  if (points_.size() == 1) return points_.front();
  const std::size_t leg = leg_at(path_m);
  const double share = (path_m - along_m_[leg]) / (along_m_[leg + 1] - along_m_[leg]);
  return points_[leg] + std::clamp(share, 0.0, 1.0) * (points_[leg + 1] - points_[leg]);
}

std::vector<Eigen::Vector3d> PathFollower::piece(double from_m, double to_m) const {
  std::vector<Eigen::Vector3d> points{place_at(from_m)};
  for (std::size_t i = 0; i < points_.size(); ++i) {
    if (along_m_[i] > from_m && along_m_[i] < to_m) points.push_back(points_[i]);
  }
  points.push_back(place_at(to_m));
  return points;
}

Eigen::Vector3d PathFollower::direction_at(double path_m) const {
  if (points_.size() == 1) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d way = place_at(path_m + 0.1) - place_at(path_m - 0.1);
  return way.norm() > 1e-9 ? Eigen::Vector3d(way.normalized()) : Eigen::Vector3d::Zero();
}

double PathFollower::allowed_speed_mps() const {
  const Braking braking{limits_.max_acceleration_mps2, limits_.reaction_s};
  double allowed = std::min(limits_.max_speed_mps,
                            std::max(kCreep_mps, speed_limit_mps(left_m(), braking).value_or(0.0)));
  for (std::size_t i = leg_at(path_m_) + 1; i < points_.size(); ++i) {
    const double ahead_m = std::max(0.0, along_m_[i] - path_m_);
    if (ahead_m > 2.0 * stopping_m() + 1.0) break;
    // Half of the acceleration brakes, so that bends and braking together stay within it.
    allowed = std::min(
        allowed, std::sqrt(speed_at_[i] * speed_at_[i] + limits_.max_acceleration_mps2 * ahead_m));
  }
  return allowed;
}

void PathFollower::advance(double dt_s) {
  const double most = limits_.max_acceleration_mps2 * dt_s;
  const double before_mps = speed_mps_;
  const double allowed = left_m() > 0.0 ? allowed_speed_mps() : 0.0;
  speed_mps_ += std::clamp(allowed - speed_mps_, -kBrakeHarder * most, 0.5 * most);
  acceleration_mps2_ = (speed_mps_ - before_mps) / dt_s;
  path_m_ = std::min(end_m(), path_m_ + speed_mps_ * dt_s);
  if (left_m() <= 1e-4) speed_mps_ = acceleration_mps2_ = 0.0;
}

sim::Setpoint PathFollower::setpoint() const {
  sim::Setpoint setpoint;
  setpoint.position_m = place_m();
  const Eigen::Vector3d along = direction_at(path_m_);
  setpoint.velocity_mps = speed_mps_ * along;
  constexpr double kAhead_s = 0.05;
  const Eigen::Vector3d turned = direction_at(path_m_ + speed_mps_ * kAhead_s);
  const Eigen::Vector3d acceleration =
      acceleration_mps2_ * along + speed_mps_ * (turned - along) / kAhead_s;
  setpoint.acceleration_mps2 = acceleration;
  return setpoint;
}

}  // namespace swiftlet
