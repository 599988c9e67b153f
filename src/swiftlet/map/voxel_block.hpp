// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>

#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/map/log_odds.hpp"

namespace swiftlet {

/// 8 x 8 x 8 voxels, x fastest, then y, then z (see offset_in_block()). 512 bytes: eight cache
/// lines.
struct alignas(64) VoxelBlock {
  std::array<QuantizedLogOdds, kBlockVoxels> voxels;

  void clear() { voxels.fill(kUnknownVoxel); }
  friend bool operator==(const VoxelBlock&, const VoxelBlock&) = default;
};
static_assert(sizeof(VoxelBlock) == kBlockVoxels);

}  // namespace swiftlet
