// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "swiftlet/base/grid_ray.hpp"

namespace swiftlet {

/// Whether floats tell the centres of neighbouring voxels apart everywhere in a box, with a
/// hundredth of a voxel to spare. Far from the origin they do not: at 900 km floats are 6 cm apart.
[[nodiscard]] inline bool floats_suffice(const std::optional<VoxelBox>& box) {
  constexpr double kMostVoxels = 1 << 17;  // 2^24 of a float's mantissa, over 128
  if (!box) return true;
  const auto far = [](std::int32_t first, std::int32_t last) {
    return std::max(std::abs(static_cast<double>(first)), std::abs(static_cast<double>(last)));
  };
  const auto& [a, b] = *box;
  return std::max({far(a.x, b.x), far(a.y, b.y), far(a.z, b.z)}) < kMostVoxels;
}

/// A place of whole metres near the middle of a box, to count coordinates from; the origin where
/// floats suffice without.
[[nodiscard]] inline Eigen::Vector3d point_origin(const std::optional<VoxelBox>& box,
                                                  double voxel_m) {
  if (floats_suffice(box)) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d middle_m =
      0.5 * (centre_of(box->first, voxel_m) + centre_of(box->last, voxel_m));
  return middle_m.array().round();
}

}  // namespace swiftlet
