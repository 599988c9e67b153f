// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "swiftlet/base/voxel_index.hpp"

namespace swiftlet {

/// A box of voxels: [first, last] along each axis, both inside.
struct VoxelBox {
  VoxelIndex first;  ///< the least index along each axis
  VoxelIndex last;   ///< the greatest

  /// Whether a voxel lies in the box.
  [[nodiscard]] constexpr bool contains(const VoxelIndex& v) const {
    return v.x >= first.x && v.x <= last.x && v.y >= first.y && v.y <= last.y && v.z >= first.z &&
           v.z <= last.z;
  }
  /// Voxels in the box, or the largest number there is if that is too small. REQUIRES: first <=
  /// last along each axis.
  [[nodiscard]] constexpr std::size_t voxel_count() const {
    const auto edge = [](std::int32_t from, std::int32_t to) {
      return static_cast<std::size_t>(std::int64_t{to} - from + 1);
    };
    const std::size_t layer = edge(first.x, last.x) * edge(first.y, last.y);  // < 2^64: x is below
    const std::size_t most = std::numeric_limits<std::size_t>::max();
    const std::size_t nz = edge(first.z, last.z);
    return layer > most / nz ? most : layer * nz;
  }
  /// Grows until it contains the voxel.
  constexpr void include(const VoxelIndex& v) {
    first = {std::min(first.x, v.x), std::min(first.y, v.y), std::min(first.z, v.z)};
    last = {std::max(last.x, v.x), std::max(last.y, v.y), std::max(last.z, v.z)};
  }
};

/// The voxels that a box of space touches, its corners in metres in the world frame.
/// REQUIRES: low <= high along each axis, both finite and on the grid (within 2^31 voxels).
[[nodiscard]] inline VoxelBox voxel_box_between(const Eigen::Vector3d& low_world,
                                                const Eigen::Vector3d& high_world, double voxel_m) {
  return {voxel_containing(low_world, voxel_m), voxel_containing(high_world, voxel_m)};
}

}  // namespace swiftlet
