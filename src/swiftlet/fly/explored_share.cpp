// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/fly/explored_share.hpp"

#include <deque>
#include <unordered_set>

namespace swiftlet {
namespace {

constexpr double kStep_m = 0.2;

}  // namespace

double explored_share(const sim::TrueClearance& truth, const RollingMap& map,
                      const OccupancyThresholds& thresholds, const Eigen::Vector3d& start_m,
                      double radius_m, const std::optional<SpaceBox>& bounds) {
  const VoxelIndex start = voxel_containing(start_m, kStep_m);
  std::unordered_set<VoxelIndex, VoxelHash> met{start};
  std::deque<VoxelIndex> waiting{start};
  std::size_t reached = 0, known = 0;
  while (!waiting.empty()) {
    const VoxelIndex place = waiting.front();
    waiting.pop_front();
    const Eigen::Vector3d p = centre_of(place, kStep_m);
    const VoxelIndex voxel = voxel_containing(p, map.voxel_m());
    if (!map.window().contains(block_of(voxel)) || (bounds && !bounds->contains(p))) continue;
    if (place != start && truth.distance_m(p, 2.0 * radius_m) <= radius_m) continue;
    ++reached;
    known += thresholds.classify(map.log_odds(voxel)) == Occupancy::kFree ? 1 : 0;
    for (int face = 0; face < 6; ++face) {
      VoxelIndex next = place;
      (face < 2 ? next.x : face < 4 ? next.y : next.z) += face % 2 == 0 ? 1 : -1;
      if (met.insert(next).second) waiting.push_back(next);
    }
  }
  return reached > 0 ? static_cast<double>(known) / static_cast<double>(reached) : 0.0;
}

}  // namespace swiftlet
