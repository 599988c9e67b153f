// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <vector>

#include "swiftlet/eval/truth/truth.hpp"

namespace swiftlet::eval {

/// A voxel that a thin cylinder runs through.
struct ThinVoxel {
  VoxelIndex voxel;
  double diameter_m = 0.0;
  Eigen::Vector3f point_m;  ///< on the axis, nearest to the middle of the voxel [world]
  float nearest_m = 0.0F;   ///< least depth at which it was in view, nothing before it; 0: never
};

/// Cylinders up to this diameter [m] are thin.
inline constexpr double kThinnest_m = 0.03;

/// The voxels of all thin cylinders of a scene.
[[nodiscard]] std::vector<ThinVoxel> thin_voxels(const Truth& truth);

/// Books from how near each voxel is seen in a view.
void look_at(std::vector<ThinVoxel>& voxels, const sim::RayCaster& world, const TrueView& view,
             const SightOptions& options);

}  // namespace swiftlet::eval
