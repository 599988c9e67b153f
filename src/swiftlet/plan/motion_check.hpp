// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>

#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/query/distance/distance_field.hpp"
#include "swiftlet/query/sweep/body_shape.hpp"
#include "swiftlet/query/sweep/sweep.hpp"

namespace swiftlet {

/// May the body be here, may it move from here to there: what a planner asks ten thousand times.
///
/// The answers are as conservative as sweep()'s. Where the distance field shows more room than the
/// body needs, it answers, in a look or two a metre; only where it does not is the body swept. The
/// body keeps the axes of the world. Thread safety: any number of questions at a time.
class MotionCheck {
 public:
  /// Looks at all four, which must stay. REQUIRES: `field` is up to date with `map`, its box is as
  /// large as the window, and it answers for what stops the body: kNotFree, or kOccupied if unknown
  /// space passes; sweep() accepts the body and the policy.
  MotionCheck(const MapSnapshot& map, const DistanceField& field, const BodyShape& body,
              const SweepPolicy& policy)
      : map_(map), field_(field), body_(body), policy_(policy) {}

  [[nodiscard]] bool is_clear(const Eigen::Vector3d& p_world) const;
  /// Straight from one place to the other. REQUIRES: both finite.
  [[nodiscard]] bool is_clear(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// A lower bound of how far the body, with its margin, is from what stops it; below 0 where the
  /// field alone cannot tell that it is clear. At most the field's reach. [m]
  [[nodiscard]] double room_m(const Eigen::Vector3d& p_world) const;
  /// Which way room_m() grows; as DistanceSample::gradient.
  [[nodiscard]] Eigen::Vector3d way_out(const Eigen::Vector3d& p_world) const;

  [[nodiscard]] const MapSnapshot& map() const { return map_; }
  [[nodiscard]] const DistanceField& field() const { return field_; }
  [[nodiscard]] const BodyShape& body() const { return body_; }
  [[nodiscard]] const SweepPolicy& policy() const { return policy_; }
  [[nodiscard]] Obstacles obstacles() const { return obstacles_of(policy_); }

  /// The kind of obstacles that stops a body under this policy.
  [[nodiscard]] static Obstacles obstacles_of(const SweepPolicy& policy) {
    return policy.unknown == UnknownSpace::kStops ? Obstacles::kNotFree : Obstacles::kOccupied;
  }

 private:
  [[nodiscard]] bool is_swept_clear(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;
  [[nodiscard]] double needed_m() const {
    return body_.reach_m() + policy_.margin_m + field_.conservative_margin_m();
  }

  const MapSnapshot& map_;
  const DistanceField& field_;
  const BodyShape& body_;
  const SweepPolicy& policy_;
};

}  // namespace swiftlet
