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

  /// Direction [world axes] of the ray through a pixel, per metre of depth.
  [[nodiscard]] Float3 direction(float u, float v) const {
    const float x = (u - cx_) * per_fx_, y = (v - cy_) * per_fy_;
    return {camera_axis_[0][0] * x + camera_axis_[1][0] * y + camera_axis_[2][0],
            camera_axis_[0][1] * x + camera_axis_[1][1] * y + camera_axis_[2][1],
            camera_axis_[0][2] * x + camera_axis_[1][2] * y + camera_axis_[2][2]};
  }
  /// World axis i of that direction, times `sign`, as the coefficients of (u, v, 1).
  [[nodiscard]] Float3 direction_row(int i, float sign) const {
    return {sign * camera_axis_[0][i] * per_fx_, sign * camera_axis_[1][i] * per_fy_,
            sign * direction_at_origin_[i]};
  }
  /// Where a point [m, camera] appears. REQUIRES: p[2] > 0.
  [[nodiscard]] std::array<float, 2> project(const Float3& p) const {
    return {fx_ * p[0] / p[2] + cx_, fy_ * p[1] / p[2] + cy_};
  }

  /// Observations that a cell gets from a frame whose every pixel is a ray through it to beyond:
  /// DW times the area of its image [px^2]. From a point, an axis-aligned cube shows at most three
  /// faces. A patch dA at q with normal n covers |n q| / q_z^3 dA of the plane z = 1; over one face
  /// |n q| is constant, and 1 / q_z^3 averages to 1 / z^3 (1 + 6 var(q_z) / z^2) around its middle.
  [[nodiscard]] float observations(const Float3& p_world, float z) const {
    float sum = 0.0F;
    for (int i = 0; i < 3; ++i) sum += face(p_world[i], z, i);
    return sum * z * z;
  }

 private:
  [[nodiscard]] float face(float p, float z, int axis) const {
    const float distance = std::max(0.0F, std::abs(p) - 0.5F * voxel_m_);
    const float z_face = z - std::copysign(half_axis_[axis], p * camera_axis_[2][axis]);
    const float per_z = 1.0F / z_face;
    const float per_z2 = per_z * per_z;
    return distance * per_z * per_z2 * (1.0F + spread_[axis] * per_z2);
  }

  double exact_voxel_m_;
  float voxel_m_;
  std::array<double, 3> camera_m_;     // where the camera is [m, world]
  std::array<Float3, 3> camera_axis_;  // its axes x, y, z [world]
  Float3 direction_at_origin_;         // of pixel (0, 0)
  Float3 half_extent_;                 // of a cube of half edge 1, in camera axes
  Float3 half_axis_;  // |depth| between a cell's centre and the middles of its faces
  Float3 spread_;     // 6 var(depth) over the faces
  float fx_, fy_, cx_, cy_, per_fx_, per_fy_;
  int width_, height_;
  float u_edge_, v_edge_;
};

}  // namespace swiftlet
