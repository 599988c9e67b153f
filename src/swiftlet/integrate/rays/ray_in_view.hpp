// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <limits>

#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/integrate/depth_view.hpp"
#include "swiftlet/preprocess/preprocessed_depth.hpp"

namespace swiftlet {

/// Depths [m] at which a ray enters and leaves a voxel, and how many voxels of depth that is.
struct RayIntersection {
  double z_in_m, z_out_m, length_voxels;
};

/// A posed camera from the side of its rays, in units of voxels along the axes of the world.
struct RayGeometry {
  RayGeometry(const DepthView& view, double voxel)
      : intrinsics(view.intrinsics),
        R_world_camera(view.T_world_camera.rotation().toRotationMatrix()),
        origin(view.T_world_camera.translation() / voxel),
        optical_axis(R_world_camera.col(2)),
        voxel_m(voxel) {}

  /// Direction [voxels, world] per metre of depth of the ray through a pixel.
  [[nodiscard]] Eigen::Vector3d direction(const PixelOrigin& pixel) const {
    return R_world_camera * intrinsics.back_project(pixel.u, pixel.v, 1.0) / voxel_m;
  }
  /// Depth [m, camera] of a voxel's centre.
  [[nodiscard]] double depth_of(const VoxelIndex& c) const {
    return optical_axis.dot(Eigen::Vector3d(c.x + 0.5, c.y + 0.5, c.z + 0.5) - origin) * voxel_m;
  }
  /// Where a ray crosses a voxel; nowhere if it only touches it, as drawn lines do.
  [[nodiscard]] RayIntersection intersection(const Eigen::Vector3d& direction,
                                             const VoxelIndex& c) const {
    RayIntersection crossed{0.0, std::numeric_limits<double>::infinity(), 0.0};
    const Eigen::Vector3d least = Eigen::Vector3d(c.x, c.y, c.z) - origin;
    for (int i = 0; i < 3; ++i) {
      if (direction[i] == 0.0) continue;
      const double a_m = least[i] / direction[i], b_m = (least[i] + 1.0) / direction[i];
      crossed.z_in_m = std::max(crossed.z_in_m, std::min(a_m, b_m));
      crossed.z_out_m = std::min(crossed.z_out_m, std::max(a_m, b_m));
    }
    crossed.z_out_m = std::max(crossed.z_in_m, crossed.z_out_m);
    crossed.length_voxels = (crossed.z_out_m - crossed.z_in_m) / voxel_m;
    return crossed;
  }

  const PinholeIntrinsics& intrinsics;
  Eigen::Matrix3d R_world_camera;
  Eigen::Vector3d origin;
  Eigen::Vector3d optical_axis;
  double voxel_m;
};

/// The ray of one reading.
struct RayInView {
  const RayGeometry& geometry;
  Eigen::Vector3d direction;  ///< as RayGeometry::direction() says
  double z_m;                 ///< depth of the reading
};

}  // namespace swiftlet
