// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/t265_axes.hpp"

namespace swiftlet {

Eigen::Vector3d from_t265_axes(const Eigen::Vector3d& v_t265) {
  return {-v_t265.z(), -v_t265.x(), v_t265.y()};
}

// C is a proper rotation, so C R C^-1 turns by the same angle about the axis C * axis: w stays, and
// the vector part changes its axes like any vector.
Eigen::Quaterniond from_t265_axes(const Eigen::Quaterniond& q_t265) {
  Eigen::Quaterniond q;
  q.w() = q_t265.w();
  q.vec() = from_t265_axes(Eigen::Vector3d(q_t265.vec()));
  return q;
}

PoseSample from_t265(Stamp stamp, const Eigen::Quaterniond& R_t265, const Eigen::Vector3d& t_t265_m,
                     std::uint8_t confidence) {
  return {stamp, from_t265_axes(R_t265), from_t265_axes(t_t265_m), confidence};
}

}  // namespace swiftlet
