// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/cube_view.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {

CubeView::CubeView(const DepthView& view, double voxel_m)
    : exact_voxel_m_(voxel_m),
      voxel_m_(static_cast<float>(voxel_m)),
      width_(view.depth.raw.width()),
      height_(view.depth.raw.height()),
      u_edge_(static_cast<float>(width_) - 0.5F),
      v_edge_(static_cast<float>(height_) - 0.5F) {
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

CubeInView CubeView::child(const CubeInView& parent, int edge, int x, int y, int z) const {
  const float step = 0.5F * static_cast<float>(edge) * voxel_m_;
  const auto side = [step](int i) { return i == 0 ? -step : step; };
  CubeInView cube;
  cube.p_world = {parent.p_world[0] + side(x), parent.p_world[1] + side(y),
                  parent.p_world[2] + side(z)};
  for (int i = 0; i < 3; ++i) {
    cube.p_camera[i] = dot(camera_axis_[i], cube.p_world);
    cube.half_camera[i] = 0.5F * parent.half_camera[i];
  }
  return cube;
}

Footprint CubeView::footprint(const CubeInView& cube) const {
  const float per_near = 1.0F / cube.z_near(), per_far = 1.0F / cube.z_far();
  const auto low = [&](int i) {
    const float edge = cube.p_camera[i] - cube.half_camera[i];
    return edge * (edge < 0.0F ? per_near : per_far);
  };
  const auto high = [&](int i) {
    const float edge = cube.p_camera[i] + cube.half_camera[i];
    return edge * (edge > 0.0F ? per_near : per_far);
  };
  return {fx_ * low(0) + cx_, fy_ * low(1) + cy_, fx_ * high(0) + cx_, fy_ * high(1) + cy_};
}

bool CubeView::meets_frustum(const CubeInView& cube) const {
  const float z = cube.z_far();
  const float x = cube.p_camera[0], ex = cube.half_camera[0];
  const float y = cube.p_camera[1], ey = cube.half_camera[1];
  return z > 0.0F && fx_ * (x + ex) + (cx_ + 0.5F) * z >= 0.0F &&
         fx_ * (x - ex) - (u_edge_ - cx_) * z <= 0.0F &&
         fy_ * (y + ey) + (cy_ + 0.5F) * z >= 0.0F && fy_ * (y - ey) - (v_edge_ - cy_) * z <= 0.0F;
}

PixelRect CubeView::pixels(const Footprint& f) const {
  const auto clamped = [](float v, int size) {
    return static_cast<int>(std::clamp(v, 0.0F, static_cast<float>(size - 1)));
  };
  return {clamped(std::floor(f.u0), width_), clamped(std::floor(f.v0), height_),
          clamped(std::ceil(f.u1), width_), clamped(std::ceil(f.v1), height_)};
}

}  // namespace swiftlet
