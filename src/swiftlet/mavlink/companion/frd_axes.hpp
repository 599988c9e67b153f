// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>

#include "swiftlet/base/frame_of.hpp"

namespace swiftlet::mavlink {

/// Axes of autopilots: x forward (or north), y to the right (or east), z down. The same turn of
/// half a circle about x leads from ours (forward, left, up) to theirs and back, for the world as
/// for the body: (x, y, z) becomes (x, -y, -z), and a rotation's vector part likewise. The one
/// place where these axes are known.
[[nodiscard]] inline Eigen::Vector3d turned_about_x(const Eigen::Vector3d& v) {
  return {v.x(), -v.y(), -v.z()};
}
[[nodiscard]] inline Eigen::Quaterniond turned_about_x(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), -q.y(), -q.z()};
}

}  // namespace swiftlet::mavlink
