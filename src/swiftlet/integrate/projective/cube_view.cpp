// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/projective/cube_view.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {

CubeView::CubeView(const DepthView& view, double voxel_m)
    : exact_voxel_m_(voxel_m),
      voxel_m_(static_cast<float>(voxel_m)),
      width_(view.depth.raw.width()),
      height_(view.depth.raw.height()) {
  // A reduced pixel stands in the middle of its n x n block.
  const double n = view.depth.ratio, shift = 0.5 * (n - 1.0);
  const PinholeIntrinsics& k = view.intrinsics;
  fx_ = static_cast<float>(k.fx() / n);
  fy_ = static_cast<float>(k.fy() / n);
  cx_ = static_cast<float>((k.cx() - shift) / n);
  cy_ = static_cast<float>((k.cy() - shift) / n);

  const Eigen::Matrix3d R = view.T_world_camera.rotation().toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    camera_m_[i] = view.T_world_camera.translation()[i];
    for (int j = 0; j < 3; ++j) camera_axis_[i][j] = static_cast<float>(R(j, i));
    const Float3& a = camera_axis_[i];
    half_extent_[i] = std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]);
    for (std::size_t place = 0; place < 8; ++place) {
      const auto along = [&](std::size_t axis) {
        return ((place >> axis) & 1U) == 0 ? -a[axis] : a[axis];
      };
      to_child_[place][i] = along(0) + along(1) + along(2);
    }
  }
}

CubeInView CubeView::cube(const VoxelIndex& first, int edge) const {
  const std::array<std::int32_t, 3> index{first.x, first.y, first.z};
  CubeInView cube;
  for (int i = 0; i < 3; ++i) {
    // Subtracted in double: far from the origin a float would not hold the centre.
    const double centre = (index[i] + 0.5 * edge) * exact_voxel_m_;
    cube.p_world[i] = static_cast<float>(centre - camera_m_[i]);
  }
  for (int i = 0; i < 3; ++i) {
    cube.p_camera[i] = dot(camera_axis_[i], cube.p_world);
    cube.half_camera[i] = 0.5F * static_cast<float>(edge) * voxel_m_ * half_extent_[i];
  }
  return cube;
}

bool CubeView::is_inside_image(const CubeInView& cube) const {
  const float near = cube.z_near(), far = cube.z_far();
  if (near <= 0.0F) return false;
  const auto is_in = [&](int axis, float focal, float centre, int size) {
    const float low = cube.p_camera[axis] - cube.half_camera[axis];
    const float high = cube.p_camera[axis] + cube.half_camera[axis];
    const float first = focal * low / (low < 0.0F ? near : far) + centre + 0.5F;
    const float last = focal * high / (high > 0.0F ? near : far) + centre + 0.5F;
    constexpr float kMargin_px = 1.0F / 16.0F;
    return first >= kMargin_px && last <= static_cast<float>(size) - kMargin_px;
  };
  return is_in(0, fx_, cx_, width_) && is_in(1, fy_, cy_, height_);
}

}  // namespace swiftlet
