// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <vector>

#include "swiftlet/query/sweep/speed_limit.hpp"
#include "swiftlet/sim/vehicle/vehicle_model.hpp"

namespace swiftlet {

/// How fast a path may be flown.
struct FollowLimits {
  double max_speed_mps = 2.0;
  double max_acceleration_mps2 = 3.0;  ///< along the path, and across it in bends
  /// From a frame's exposure until the vehicle brakes for what it shows.
  double reaction_s = 0.3;
};

/// A point that runs along a path at a speed from which it can always stop at the path's end: what
/// the vehicle is told to follow. A path ends where known free space does, or before; so wherever
/// the vehicle is, it can stop in what is known to be free.
///
/// Speed: at most speed_limit_mps() of the path that is left, so that what a new frame shows beyond
/// it comes in time; in bends so slow that the acceleration across stays within the limit; before
/// bends and the end early enough.
class PathFollower {
 public:
  PathFollower(const FollowLimits& limits, const Eigen::Vector3d& place);

  /// Flies on along another path. REQUIRES: points.front() is place_m(), or nearly.
  void follow(std::vector<Eigen::Vector3d> points);
  /// The path is good no farther than this. [m along the path]
  void stop_at(double path_m);
  void advance(double dt_s);

  [[nodiscard]] double path_m() const { return path_m_; }  ///< where the point is
  [[nodiscard]] double end_m() const { return along_m_.back(); }
  [[nodiscard]] double left_m() const { return end_m() - path_m_; }
  [[nodiscard]] double speed_mps() const { return speed_mps_; }
  /// How much farther it moves if it brakes now.
  [[nodiscard]] double stopping_m() const {
    return speed_mps_ * speed_mps_ / (2.0 * limits_.max_acceleration_mps2);
  }
  [[nodiscard]] Eigen::Vector3d place_m() const { return place_at(path_m_); }
  [[nodiscard]] Eigen::Vector3d place_at(double path_m) const;
  /// The piece of the path between two lengths along it, its corners included.
  [[nodiscard]] std::vector<Eigen::Vector3d> piece(double from_m, double to_m) const;
  /// Place, velocity and acceleration of the point.
  [[nodiscard]] sim::Setpoint setpoint() const;

 private:
  void set_limits();
  [[nodiscard]] Eigen::Vector3d direction_at(double path_m) const;
  [[nodiscard]] std::size_t leg_at(double path_m) const;
  [[nodiscard]] double allowed_speed_mps() const;

  FollowLimits limits_;
  std::vector<Eigen::Vector3d> points_;
  std::vector<double> along_m_;   // of each point
  std::vector<double> speed_at_;  // that each point may be passed with [m/s]
  double path_m_ = 0.0;
  double speed_mps_ = 0.0;
  double acceleration_mps2_ = 0.0;
};

}  // namespace swiftlet
