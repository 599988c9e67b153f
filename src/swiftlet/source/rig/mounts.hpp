// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/frame/pose_sample.hpp"

namespace swiftlet {

/// In which axes a mount or a pose is written down.
enum class BodyAxes {
  kRep103,   ///< x forward, y left, z up: ours, ROS
  kT265,     ///< x right, y up, z backward: the device's own
  kOptical,  ///< x right, y down, z forward: of a camera
};
inline constexpr std::array<std::string_view, 3> kBodyAxesNames{"rep103", "t265", "optical"};
[[nodiscard]] std::optional<BodyAxes> body_axes_from(std::string_view name);

/// A mount as others write it, p_body = R p_camera + t with the body in its own axes, in ours.
/// Errors: kInvalidConfig if R is no rotation (its determinant or columns) or t is not finite.
[[nodiscard]] Expected<Transform<Body, Camera>> mount_from_matrix(
    const Eigen::Matrix<double, 3, 4>& T_body_camera, BodyAxes axes);

/// Intel's printed bracket: D435 above, T265 below it, both looking forward (the calibration of one
/// unit, published with the SDK as H_t265_d400.cfg; yours differs by millimetres).
[[nodiscard]] Transform<Body, Camera> intel_t265_d435_mount();

/// Where a camera looks, as the user says, to be held against its mount.
inline constexpr std::array<std::string_view, 6> kDirections{"forward", "back", "left",
                                                             "right",   "up",   "down"};

/// Checks that a mount can be meant: the camera within `max_distance_m` of the body's origin (a
/// distance in millimetres is not) and, if `looks` is not empty, its optical axis within 60 degrees
/// of that direction (swapped axes are not).
/// Errors: kInvalidConfig.
[[nodiscard]] Status check_mount(const Transform<Body, Camera>& T_body_camera,
                                 std::string_view looks, double max_distance_m = 2.0);

/// A pose of a level world in whatever axes it was written, in ours. A camera's own axes turn the
/// body only: the world of such a pose is level already.
[[nodiscard]] PoseSample in_our_axes(const PoseSample& pose, BodyAxes axes);

}  // namespace swiftlet
