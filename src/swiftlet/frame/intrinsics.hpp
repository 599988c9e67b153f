// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// Pinhole camera without distortion (D400 depth images are rectified on the device).
/// Pixel (u, v) is centred at integer coordinates, as in OpenCV and librealsense.
class PinholeIntrinsics {
 public:
  /// Focal lengths and principal point [px]. Errors: kCorruptInput if singular, not finite, or the
  /// image has no pixels or more than 16384 a side.
  [[nodiscard]] static Expected<PinholeIntrinsics> create(int width, int height, double fx_px,
                                                          double fy_px, double cx_px, double cy_px);
  /// f = 0.5 * width / tan(hfov / 2), square pixels, principal point in the middle (method 3).
  [[nodiscard]] static Expected<PinholeIntrinsics> from_field_of_view(int width, int height,
                                                                      double hfov_rad);

  /// Of the image [px]
  [[nodiscard]] int width() const { return width_; }
  /// Of the image [px]
  [[nodiscard]] int height() const { return height_; }
  /// Focal length along x [px]
  [[nodiscard]] double fx() const { return fx_; }
  /// Focal length along y [px]
  [[nodiscard]] double fy() const { return fy_; }
  /// Principal point along x [px]
  [[nodiscard]] double cx() const { return cx_; }
  /// Principal point along y [px]
  [[nodiscard]] double cy() const { return cy_; }

  /// The point [m, camera] that pixel (u, v) sees at depth z along the optical axis.
  [[nodiscard]] Eigen::Vector3d back_project(double u, double v, double z_m) const {
    return {(u - cx_) / fx_ * z_m, (v - cy_) / fy_ * z_m, z_m};
  }
  /// Pixel coordinates of a point [m, camera]. REQUIRES: p_camera.z() > 0.
  [[nodiscard]] Eigen::Vector2d project(const Eigen::Vector3d& p_camera) const {
    return {fx_ * p_camera.x() / p_camera.z() + cx_, fy_ * p_camera.y() / p_camera.z() + cy_};
  }

  friend bool operator==(const PinholeIntrinsics&, const PinholeIntrinsics&) = default;

 private:
  PinholeIntrinsics(int width, int height, double fx, double fy, double cx, double cy)
      : width_(width), height_(height), fx_(fx), fy_(fy), cx_(cx), cy_(cy) {}

  int width_, height_;
  double fx_, fy_, cx_, cy_;
};

}  // namespace swiftlet
