// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/integrate/depth_view.hpp"

namespace swiftlet {

using Float3 = std::array<float, 3>;

/// Summed in this order on every machine: the map's bits depend on it.
[[nodiscard]] inline float dot(const Float3& a, const Float3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// A cube of voxels as the camera sees it. Positions are relative to the camera.
struct CubeInView {
  Float3 p_world;      ///< centre [m, world axes]
  Float3 p_camera;     ///< centre [m, camera axes]
  Float3 half_camera;  ///< half extents of its bounding box in camera axes [m]

  [[nodiscard]] float z_near() const { return p_camera[2] - half_camera[2]; }
  [[nodiscard]] float z_far() const { return p_camera[2] + half_camera[2]; }
};

/// One posed depth image, looked at from the side of the voxels. Pixels are those of the reduced
/// image: n x n pixels of the full one each.
class CubeView {
 public:
  CubeView(const DepthView& view, double voxel_m);

  [[nodiscard]] float voxel_m() const { return voxel_m_; }
  [[nodiscard]] int width() const { return width_; }
  [[nodiscard]] int height() const { return height_; }
  [[nodiscard]] const Float3& optical_axis() const { return camera_axis_[2]; }

  /// A cube of `edge` voxels a side whose first voxel is `first`.
  [[nodiscard]] CubeInView cube(const VoxelIndex& first, int edge) const;
  /// Whether the image of a cube before the camera lies within the image, and 1/16 pixel more.
  [[nodiscard]] bool is_inside_image(const CubeInView& cube) const;
  /// One of the eight octants, `edge` voxels wide, of a cube: the bits of `place` tell its side
  /// along x, y and z.
  [[nodiscard]] CubeInView child(const CubeInView& parent, int edge, int place) const {
    const float step = 0.5F * static_cast<float>(edge) * voxel_m_;
    CubeInView cube;
    for (int i = 0; i < 3; ++i) {
      cube.p_world[i] = parent.p_world[i] + (((place >> i) & 1) == 0 ? -step : step);
      cube.p_camera[i] = parent.p_camera[i] + step * to_child_[static_cast<std::size_t>(place)][i];
      cube.half_camera[i] = 0.5F * parent.half_camera[i];
    }
    return cube;
  }

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
  std::array<Float3, 8> to_child_;     // of a cube of half edge 2, in camera axes
  Float3 half_extent_;                 // of a cube of half edge 1, in camera axes
  float fx_, fy_, cx_, cy_;
  int width_, height_;
};

}  // namespace swiftlet
