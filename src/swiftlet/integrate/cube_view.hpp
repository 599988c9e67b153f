// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "swiftlet/condition/conditioned_depth.hpp"
#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/integrate/depth_pyramid.hpp"
#include "swiftlet/integrate/integrator.hpp"

namespace swiftlet {

using Float3 = std::array<float, 3>;

/// Summed in this order on every machine: the map's bits depend on it.
[[nodiscard]] inline float dot(const Float3& a, const Float3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A cube of cells as the camera sees it. Positions are relative to the camera.
struct CubeInView {
  Float3 p_world;      ///< centre [m, world axes]
  Float3 p_camera;     ///< centre [m, camera axes]
  Float3 half_camera;  ///< half extents of its bounding box in camera axes [m]

  [[nodiscard]] float z_near() const { return p_camera[2] - half_camera[2]; }
  [[nodiscard]] float z_far() const { return p_camera[2] + half_camera[2]; }
};

/// Rectangle in pixel coordinates; pixel u covers [u - 0.5, u + 0.5).
struct Footprint {
  float u0, v0, u1, v1;
};

/// One posed depth image, looked at from the side of the cells. Pixels are those of the reduced
/// image: n x n pixels of the full one each.
class CubeView {
 public:
  CubeView(const DepthView& view, double voxel_m);

  [[nodiscard]] float voxel_m() const { return voxel_m_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const Float3& optical_axis() const { return camera_axis_[2]; }

  /// A cube of `edge` cells a side whose first cell is `first`.
  [[nodiscard]] CubeInView cube(const VoxelIndex& first, int edge) const;
  /// The cube of `edge` cells of a larger one, by its place among its siblings (0 or 1 each axis).
  [[nodiscard]] CubeInView child(const CubeInView& parent, int edge, int x, int y, int z) const;

  /// Bounds of the cube's image. REQUIRES: z_near() > 0.
  [[nodiscard]] Footprint footprint(const CubeInView& cube) const;
  [[nodiscard]] bool meets_image(const Footprint& f) const {
    return f.u1 >= -0.5F && f.v1 >= -0.5F && f.u0 <= u_edge_ && f.v0 <= v_edge_;
  }
  /// Whether any of a cube that the camera's plane may cut lies between the four sides of the view.
  [[nodiscard]] bool meets_frustum(const CubeInView& cube) const;
  [[nodiscard]] bool is_inside_image(const Footprint& f) const {
    return f.u0 >= -0.5F && f.v0 >= -0.5F && f.u1 <= u_edge_ && f.v1 <= v_edge_;
  }
  /// All pixels that a footprint touches. REQUIRES: meets_image(f).
  [[nodiscard]] PixelRect pixels(const Footprint& f) const;

  /// The world's axes in camera axes.
  [[nodiscard]] std::array<Float3, 3> world_axis() const {
    std::array<Float3, 3> axes;
    for (int i = 0; i < 3; ++i)
      axes[i] = {camera_axis_[0][i], camera_axis_[1][i], camera_axis_[2][i]};
    return axes;
  }
  [[nodiscard]] float fx() const { return fx_; }
  [[nodiscard]] float fy() const { return fy_; }
  [[nodiscard]] float cx() const { return cx_; }
  [[nodiscard]] float cy() const { return cy_; }

 private:
  double exact_voxel_m_;
  float voxel_m_;
  std::array<double, 3> camera_m_;     // where the camera is [m, world]
  std::array<Float3, 3> camera_axis_;  // its axes x, y, z [world]
  Float3 half_extent_;                 // of a cube of half edge 1, in camera axes
  float fx_, fy_, cx_, cy_;
  int width_, height_;
  float u_edge_, v_edge_;
};

}  // namespace swiftlet
