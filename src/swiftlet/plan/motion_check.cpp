// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/plan/motion_check.hpp"

#include <array>

namespace swiftlet {

double MotionCheck::room_m(const Eigen::Vector3d& p_world) const {
  return field_.sample(p_world, obstacles()).distance_m - needed_m();
}

Eigen::Vector3d MotionCheck::way_out(const Eigen::Vector3d& p_world) const {
  return field_.sample(p_world, obstacles()).gradient;
}

bool MotionCheck::is_swept_clear(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  const std::array ends{from, to};
  const auto path = SweepPath::along(ends);
  if (!path) return false;
  const auto answer = sweep(map_, body_, *path, policy_);
  return answer && answer->state == SweepState::kClear;
}

bool MotionCheck::is_clear(const Eigen::Vector3d& p_world) const {
  return room_m(p_world) > 0.0 || is_swept_clear(p_world, p_world);
}

// What the body has room for, it may move by, in any direction: from ball to ball along the way.
bool MotionCheck::is_clear(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const {
  const double length_m = (to - from).norm();
  const double least_step_m = 0.5 * map_.voxel_m();
  double done_m = 0.0;
  while (done_m < length_m) {
    const Eigen::Vector3d here = from + done_m / length_m * (to - from);
    const double room = room_m(here);
    if (room < least_step_m) return is_swept_clear(here, to);
    done_m += room;
  }
  return length_m > 0.0 || is_clear(from);
}

}  // namespace swiftlet
