// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/grid_ray.hpp"
#include "swiftlet/map/occupancy_map.hpp"

namespace swiftlet {

/// What a ray met first.
struct RayHit {
  Occupancy state;    ///< kFree: nothing in the way; kOccupied: matter; kUnknown: never seen
  double distance_m;  ///< along the ray to the face of `voxel`, or the whole length if kFree
  VoxelIndex voxel;   ///< the first voxel that is not free; the last one if all are free or the ray
                      ///< leaves the map
};

/// Whether unknown space stops a ray. A planner that flies into unknown space says kPasses, and
/// means it.
enum class UnknownSpace { kStops, kPasses };

/// Follows a segment [m, world] through every voxel it crosses, up to the first that is not free.
/// Voxels outside the map are unknown. By thresholds of the caller's, or those of the map.
/// REQUIRES: both ends finite. Cost: O(length / voxel_m). Does not allocate.
template <OccupancyMap Map>
[[nodiscard]] RayHit cast_ray(const Map& map, const Eigen::Vector3d& from_world,
                              const Eigen::Vector3d& to_world,
                              const OccupancyThresholds& thresholds,
                              UnknownSpace unknown = UnknownSpace::kStops) {
  SWIFTLET_REQUIRE(from_world.allFinite() && to_world.allFinite(), "a ray has finite ends");
  const double voxel_m = map.voxel_m();
  const double length_m = (to_world - from_world).norm();
  const GridRay ray{from_world / voxel_m, to_world / voxel_m};
  const BlockWindow extent = map.extent();
  const VoxelBox box = voxel_box(extent);
  const Clip clip = extent.is_empty() ? Clip{1.0, 0.0} : clip_to_box(ray, box);
  const bool unknown_stops = unknown == UnknownSpace::kStops;

  const bool starts_outside = clip.is_empty() || clip.begin > 0.0;
  if (starts_outside && unknown_stops)
    return {Occupancy::kUnknown, 0.0, voxel_containing(from_world, voxel_m)};
  const RayHit clear{Occupancy::kFree, length_m, voxel_containing(to_world, voxel_m)};
  if (clip.is_empty()) return clear;

  GridWalk walk(ray, box, clip);
  do {
    const Occupancy state = thresholds.classify(map.log_odds(walk.voxel()));
    const bool stops =
        state == Occupancy::kOccupied || (state == Occupancy::kUnknown && unknown_stops);
    if (stops) return {state, walk.entered_at() * length_m, walk.voxel()};
  } while (walk.advance());

  const bool ends_outside = clip.end < 1.0;
  if (!ends_outside || !unknown_stops) return clear;
  return {Occupancy::kUnknown, clip.end * length_m, walk.voxel()};
}
/// By the map's own thresholds.
template <OccupancyMap Map>
[[nodiscard]] RayHit cast_ray(const Map& map, const Eigen::Vector3d& from_world,
                              const Eigen::Vector3d& to_world,
                              UnknownSpace unknown = UnknownSpace::kStops) {
  return cast_ray(map, from_world, to_world, OccupancyThresholds(map.scale().thresholds), unknown);
}

}  // namespace swiftlet
