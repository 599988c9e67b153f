// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/voxel_counts.hpp"

namespace swiftlet {

void VoxelCounts::add(const VoxelBlock& block, const OccupancyThresholds& thresholds) {
  for (const QuantizedLogOdds voxel : block.voxels) add(thresholds.classify(voxel));
}

}  // namespace swiftlet
