// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <octomap/OcTreeKey.h>

#include <algorithm>
#include <cstdint>

#include "swiftlet/base/voxel_index.hpp"

namespace swiftlet::eval {

/// OctoMap counts its voxels from here, on the same grid as ours.
inline constexpr int kZeroKey = 32768;

[[nodiscard]] inline VoxelIndex voxel_of(const octomap::OcTreeKey& key) {
  return {key[0] - kZeroKey, key[1] - kZeroKey, key[2] - kZeroKey};
}

/// Beyond the reach of OctoMap, the last one that it has.
[[nodiscard]] inline octomap::OcTreeKey key_of(const VoxelIndex& v) {
  const auto key = [](std::int32_t i) {
    return static_cast<octomap::key_type>(std::clamp(i + kZeroKey, 0, 2 * kZeroKey - 1));
  };
  return {key(v.x), key(v.y), key(v.z)};
}

}  // namespace swiftlet::eval
