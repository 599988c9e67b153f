// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cmath>

#include "swiftlet/base/frame_of.hpp"

namespace swiftlet {

/// What a planner knows of a camera: how wide it sees, how far, and how it is mounted.
struct ViewCamera {
  double hfov_rad = 1.5;     ///< from the left edge of the image to the right one
  double vfov_rad = 1.0;     ///< from the upper edge to the lower one
  double max_range_m = 5.0;  ///< along the optical axis, as depth is measured
  Transform<Body, Camera> T_body_camera = forward_looking_camera();  ///< where it is mounted

  /// Angles above 0 and below 170 degrees, a range that is finite and above 0.
  [[nodiscard]] bool is_sound() const {
    constexpr double kWidest_rad = 2.97;
    const auto is_angle = [](double v) { return v > 0.0 && v < kWidest_rad; };  // false for NaN
    return is_angle(hfov_rad) && is_angle(vfov_rad) && max_range_m > 0.0 &&
           std::isfinite(max_range_m);
  }
  /// Whether a point [m, camera] lies in the image and within range.
  [[nodiscard]] bool covers(const Eigen::Vector3d& p_camera) const {
    const double z = p_camera.z();
    return z > 0.0 && z <= max_range_m && std::abs(p_camera.x()) <= z * std::tan(0.5 * hfov_rad) &&
           std::abs(p_camera.y()) <= z * std::tan(0.5 * vfov_rad);
  }
};

}  // namespace swiftlet
