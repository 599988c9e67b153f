// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/map_summary.hpp"

#include "swiftlet/query/known_voxels.hpp"

namespace swiftlet {

void MapSummary::add(const BlockIndex& index, const VoxelBlock& block,
                     const OccupancyThresholds& thresholds) {
  voxels.add(block, thresholds);
  for_each_known_voxel(index, block, thresholds,
                       [&](const VoxelIndex& v, QuantizedLogOdds, Occupancy) {
                         if (!bounds) bounds = VoxelBox{v, v};
                         bounds->include(v);
                       });
}

}  // namespace swiftlet
