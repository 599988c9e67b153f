// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/mounts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/source/rig/t265_axes.hpp"

namespace swiftlet {
namespace {

/// Turns points of a body in other axes into ours.
Eigen::Matrix3d body_from(BodyAxes axes) {
  Eigen::Matrix3d C = Eigen::Matrix3d::Identity();
  if (axes == BodyAxes::kT265) C << 0, 0, -1, -1, 0, 0, 0, 1, 0;
  if (axes == BodyAxes::kOptical) C << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  return C;
}

Eigen::Vector3d direction(std::string_view looks) {
  const auto axis = static_cast<int>(std::ranges::find(kDirections, looks) - kDirections.begin());
  Eigen::Vector3d d = Eigen::Vector3d::Zero();
  d[axis / 2] = axis % 2 == 0 ? 1.0 : -1.0;
  return d;
}

}  // namespace

std::optional<BodyAxes> body_axes_from(std::string_view name) {
  const auto found = std::ranges::find(kBodyAxesNames, name);
  if (found == kBodyAxesNames.end()) return std::nullopt;
  return static_cast<BodyAxes>(found - kBodyAxesNames.begin());
}

Expected<Transform<Body, Camera>> mount_from_matrix(
    const Eigen::Matrix<double, 3, 4>& T_body_camera, BodyAxes axes) {
  const Eigen::Matrix3d R = T_body_camera.leftCols<3>();
  if (const double det = R.determinant(); !(std::abs(det - 1.0) < 0.01)) {
    return fail(ErrorCode::kInvalidConfig, {},
                fmt::format("its left 3 x 3 part is no rotation: the determinant is {:.4f}", det),
                det < 0 ? "an axis points the wrong way: -1 is a mirror image"
                        : "write the rows of [R t] one after the other");
  }
  Eigen::Matrix4d M = Eigen::Matrix4d::Identity();
  M.topRows<3>() = body_from(axes) * T_body_camera;
  auto T = Transform<Body, Camera>::from_matrix(M);
  if (!T) T.error().code = ErrorCode::kInvalidConfig;
  return T;
}

Transform<Body, Camera> intel_t265_d435_mount() {
  Eigen::Matrix<double, 3, 4> H;
  H << 0.999968402, -0.006753626, -0.004188075, -0.015890727,  //
      -0.006685408, -0.999848172, 0.016093893, 0.028273059,    //
      -0.004296131, -0.016065384, -0.999861654, -0.009375589;
  const auto T = mount_from_matrix(H, BodyAxes::kT265);
  SWIFTLET_REQUIRE(T.has_value(), "the preset is a rotation");
  return *T;
}

Status check_mount(const Transform<Body, Camera>& T_body_camera, std::string_view looks,
                   double max_distance_m) {
  const double distance_m = T_body_camera.translation().norm();
  if (!(distance_m <= max_distance_m)) {
    return fail(ErrorCode::kInvalidConfig, {},
                fmt::format("the camera would sit {:.3g} m from the body's origin", distance_m),
                "lengths are in metres");
  }
  if (looks.empty()) return Done{};
  const Eigen::Vector3d axis = T_body_camera.rotation() * Eigen::Vector3d::UnitZ();
  const double off_rad = std::acos(std::clamp(axis.dot(direction(looks)), -1.0, 1.0));
  if (off_rad <= std::numbers::pi / 3) return Done{};
  return fail(
      ErrorCode::kInvalidConfig, {},
      fmt::format("by its mount the camera looks along ({:.2f}, {:.2f}, {:.2f}) of the "
                  "body, {:.0f} degrees off '{}'",
                  axis.x(), axis.y(), axis.z(), off_rad * 180 / std::numbers::pi, looks),
      "check its 'axes' (rep103: x forward, y left, z up; t265: x right, y up, z backward)");
}

PoseSample in_our_axes(const PoseSample& pose, BodyAxes axes) {
  PoseSample ours = pose;
  if (axes == BodyAxes::kT265) {
    ours.R_world_body = from_t265_axes(pose.R_world_body);
    ours.t_world_body_m = from_t265_axes(pose.t_world_body_m);
  }
  if (axes == BodyAxes::kOptical)
    ours.R_world_body = pose.R_world_body * forward_looking_camera().rotation().conjugate();
  return ours;
}

}  // namespace swiftlet
