// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/ray_query.hpp"

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/grid_ray.hpp"

namespace swiftlet {

RayHit cast_ray(const MapSnapshot& map, const Eigen::Vector3d& from_world,
                const Eigen::Vector3d& to_world, const OccupancyThresholds& thresholds,
                UnknownSpace unknown) {
  SWIFTLET_REQUIRE(from_world.allFinite() && to_world.allFinite(), "a ray has finite ends");
  const double length_m = (to_world - from_world).norm();
  const GridRay ray{from_world / map.voxel_m(), to_world / map.voxel_m()};
  const VoxelBox window = voxel_box(map.window());
  const Clip clip = clip_to_box(ray, window);
  const bool unknown_stops = unknown == UnknownSpace::kStops;

  const bool starts_outside = clip.is_empty() || clip.begin > 0.0;
  if (starts_outside && unknown_stops) {
    return {Occupancy::kUnknown, 0.0, voxel_containing(from_world, map.voxel_m())};
  }
  const RayHit clear{Occupancy::kFree, length_m, voxel_containing(to_world, map.voxel_m())};
  if (clip.is_empty()) return clear;

  GridWalk walk(ray, window, clip);
  do {
    const Occupancy state = thresholds.classify(map.log_odds(walk.cell()));
    const bool stops =
        state == Occupancy::kOccupied || (state == Occupancy::kUnknown && unknown_stops);
    if (stops) return {state, walk.entered_at() * length_m, walk.cell()};
  } while (walk.advance());

  const bool ends_outside = clip.end < 1.0;
  if (!ends_outside || !unknown_stops) return clear;
  return {Occupancy::kUnknown, clip.end * length_m, walk.cell()};
}

}  // namespace swiftlet
