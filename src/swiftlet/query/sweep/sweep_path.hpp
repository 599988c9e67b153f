// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// Where the body is to be, and when.
struct TimedPose {
  Stamp stamp;                          ///< when the body is there
  Transform<World, Body> T_world_body;  ///< where
};

/// A path for sweep(): points without turning, or poses with times. Looks at the caller's memory,
/// which must stay as it is while the path is used.
///
/// Between two poses the place moves straight and the attitude turns evenly (SLERP), both at the
/// same share of the way. One point or pose alone is a path, too: the body at rest.
class SweepPath {
 public:
  /// Two points are a segment, more a polyline; the axes of the body stay those of the world.
  /// Errors: kUsage if there is no point, or one is not finite or beyond 1000 km of the origin.
  [[nodiscard]] static Expected<SweepPath> along(std::span<const Eigen::Vector3d> points_world);
  /// Errors: as above, and if a stamp is before the one before it.
  [[nodiscard]] static Expected<SweepPath> of(std::span<const TimedPose> poses);

  /// Poses.
  [[nodiscard]] std::size_t size() const {
    return points_.empty() ? poses_.size() : points_.size();
  }
  /// The pose of that number. REQUIRES: i < size().
  [[nodiscard]] Transform<World, Body> pose(std::size_t i) const {
    return points_.empty()
               ? poses_[i].T_world_body
               : Transform<World, Body>::trusted(Eigen::Quaterniond::Identity(), points_[i]);
  }
  /// 0 on a path without times.
  [[nodiscard]] Stamp stamp(std::size_t i) const {
    return points_.empty() ? poses_[i].stamp : Stamp{};
  }

 private:
  SweepPath() = default;

  std::span<const Eigen::Vector3d> points_;
  std::span<const TimedPose> poses_;  // one of the two is empty
};

}  // namespace swiftlet
