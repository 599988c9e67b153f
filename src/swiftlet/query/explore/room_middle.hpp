// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <optional>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/query/ray_query.hpp"

namespace swiftlet {

/// What counts as a wall, and what as a door.
struct RoomOptions {
  OccupancyThresholds thresholds{};             ///< where belief becomes a claim
  UnknownSpace unknown = UnknownSpace::kStops;  ///< kStops: unknown voxels bound the room, too
  double half_height_m = 0.2;                   ///< the slab at flying height reaches up and down
  double door_m = 1.0;                          ///< what is narrower than this parts two rooms
};

/// Where there is most room around.
struct RoomMiddle {
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();  ///< at the height of the vehicle
  double clearance_m = 0.0;                           ///< no obstacle in the slab is nearer to it
  double area_m2 = 0.0;  ///< of the room, without what is nearer to a wall than half a door
};

/// The middle of the room that the vehicle is in (thesis 5.1), as far as it has been seen: turn
/// once in place, then ask.
///
/// Not the point of greatest clearance: in an oblong room there are many, from one end to the
/// other. All voxels that have it but for one and a half voxels are a plateau along the room; the
/// middle is their mean, weighted by what they have more. Where a room is bent so that the mean
/// lies outside the plateau, it is the voxel of the plateau that is nearest to it. nullopt if the
/// vehicle is in no free space wide enough. Errors: kUsage if a number cannot be used. Cost:
/// O(voxels of a slab of the window x its widest clearance). Allocates.
[[nodiscard]] Expected<std::optional<RoomMiddle>> room_middle(const MapSnapshot& map,
                                                              const Eigen::Vector3d& p_world,
                                                              const RoomOptions& options = {});

}  // namespace swiftlet
