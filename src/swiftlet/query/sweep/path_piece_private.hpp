// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "swiftlet/query/sweep/moving_part_private.hpp"
#include "swiftlet/query/sweep/sweep_path.hpp"

namespace swiftlet {

/// A part of a path between two poses, and the body that moves along it. [voxels]
///
/// Within a piece, the body is taken to move with the attitude of its middle, and to be larger by
/// what its turn within the piece moves any of its points at most: a chord of the half turn about
/// the origin. So what a piece touches holds all that the true motion touches; short pieces make it
/// exact.
class PathLeg {
 public:
  PathLeg(const Transform<World, Body>& from, const Transform<World, Body>& to, double voxels_per_m)
      : from_(from.translation() * voxels_per_m),
        step_((to.translation() - from.translation()) * voxels_per_m),
        attitude_(from.rotation()),
        end_attitude_(to.rotation()),
        turn_rad_(from.rotation().angularDistance(to.rotation())),
        voxels_per_m_(voxels_per_m) {
    // Quaternions are rounded; an angle below this is nothing else.
    constexpr double kNoTurn_rad = 1e-13;
    if (turn_rad_ < kNoTurn_rad) turn_rad_ = 0.0;
  }

  [[nodiscard]] double length() const { return step_.norm(); }
  [[nodiscard]] const Eigen::Vector3d& from() const { return from_; }
  [[nodiscard]] Eigen::Vector3d at(double share) const { return from_ + share * step_; }
  [[nodiscard]] double turn_rad() const { return turn_rad_; }

  /// By how much the turn within a piece of this share moves a point at the lever, at most.
  [[nodiscard]] double growth(double shares, double lever) const {
    const double half_turn = std::min(0.5 * turn_rad_ * shares, std::numbers::pi);
    return 2.0 * std::sin(0.5 * half_turn) * lever;
  }

  /// The body half way between two shares of the way.
  struct Placement {
    Eigen::Matrix3d R;
    Eigen::Vector3d middle;
    Eigen::Vector3d half_move;
    double growth;
  };
  [[nodiscard]] Placement piece(double begin, double end, double lever) const {
    const double middle = 0.5 * (begin + end);
    const Eigen::Quaterniond attitude =
        turn_rad_ == 0.0 ? attitude_ : attitude_.slerp(middle, end_attitude_);
    return {attitude.normalized().toRotationMatrix(), at(middle), 0.5 * (end - begin) * step_,
            growth(end - begin, lever)};
  }
  [[nodiscard]] MovingPart moving(const BodyShape::Part& part, const Placement& at,
                                  double extra_radius) const {
    return make_moving_part(part, at.R, at.middle, at.half_move, voxels_per_m_,
                            extra_radius + at.growth);
  }

 private:
  Eigen::Vector3d from_;
  Eigen::Vector3d step_;
  Eigen::Quaterniond attitude_;
  Eigen::Quaterniond end_attitude_;
  double turn_rad_;
  double voxels_per_m_;
};

/// Calls visit(begin, end) for pieces of a leg within [first, last], in order, until it returns
/// false: short enough that the box around each is not much larger than the body, and that turns
/// make it grow by `growth` at most.
template <class Visit>
bool for_each_piece(const PathLeg& leg, double first, double last, double longest, double lever,
                    double growth, Visit&& visit) {
  const double by_length = (last - first) * leg.length() / longest;
  const double by_turn = (last - first) * leg.turn_rad() * lever / (2.0 * growth);
  const auto pieces =
      static_cast<std::int64_t>(std::max(1.0, std::ceil(std::max(by_length, by_turn))));
  const double share = (last - first) / static_cast<double>(pieces);
  for (std::int64_t i = 0; i < pieces; ++i) {
    const double begin = first + share * static_cast<double>(i);
    const double end = i + 1 == pieces ? last : first + share * static_cast<double>(i + 1);
    if (!visit(begin, end)) return false;
  }
  return true;
}

}  // namespace swiftlet
