// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>

#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/map_snapshot.hpp"

namespace swiftlet {

/// What a ray met first.
struct RayHit {
  Occupancy state;    ///< kFree: nothing in the way; kOccupied: matter; kUnknown: never seen
  double distance_m;  ///< along the ray to the face of `voxel`, or the whole length if kFree
  VoxelIndex voxel;   ///< the first cell that is not free; the last one if all are free or the ray
                      ///< leaves the window
};

/// Whether unknown space stops a ray. A planner that flies into unknown space says kPasses, and
/// means it.
enum class UnknownSpace { kStops, kPasses };

/// Follows a segment [m, world] through every cell it crosses, up to the first that is not free.
/// Cells outside the window are unknown. REQUIRES: both ends finite.
/// Cost: O(length / voxel_m). Does not allocate.
[[nodiscard]] RayHit cast_ray(const MapSnapshot& map, const Eigen::Vector3d& from_world,
                              const Eigen::Vector3d& to_world,
                              const OccupancyThresholds& thresholds,
                              UnknownSpace unknown = UnknownSpace::kStops);

}  // namespace swiftlet
