// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>

#include "swiftlet/frame/pose_sample.hpp"

namespace swiftlet {

/// Turns samples of a RealSense T265 into ours. The device reports the pose of itself in a
/// gravity-aligned world that starts where and as it starts; device and world both have x right, y
/// up, z backward (OpenGL). Ours (REP-103) have x forward, y left, z up:
///
///     T_world_body = C * T_t265 * C^-1,    C = |  0  0 -1 |
///                                              | -1  0  0 |
///                                              |  0  1  0 |
///
/// for the rotation as well as the translation, as both frames change their axes. The one place
/// where T265 axes are known.
[[nodiscard]] Eigen::Vector3d from_t265_axes(const Eigen::Vector3d& v_t265);
[[nodiscard]] Eigen::Quaterniond from_t265_axes(const Eigen::Quaterniond& q_t265);

/// A whole sample; what is not finite stays so, for the Rig to refuse and count.
[[nodiscard]] PoseSample from_t265(Stamp stamp, const Eigen::Quaterniond& R_t265,
                                   const Eigen::Vector3d& t_t265_m, std::uint8_t confidence);

}  // namespace swiftlet
