// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/map/map_snapshot.hpp"

namespace swiftlet::mavlink {

/// Directions around the vehicle. Sector i covers [5 i - 2.5, 5 i + 2.5) degrees clockwise from the
/// nose, as both autopilots have it.
inline constexpr std::size_t kSectors = 72;

/// What flies, as a level cylinder about the body's origin, and how far is looked. [m]
struct RingOptions {
  double body_radius_m = 0.3;
  double body_height_m = 0.3;
  /// Above and below the body: what lies within is in the way, too.
  double margin_m = 0.2;
  double max_m = 12.0;
  /// Voxels that are unknown nearer than this say nothing: no camera sees so near, and the vehicle
  /// itself was there.
  double blind_m = 0.8;
};

/// What lies in one direction; infinite if there is none within `max_m`. [m]
struct SectorView {
  static constexpr double kNone = std::numeric_limits<double>::infinity();
  double occupied_m = kNone;  ///< the nearest matter
  double unknown_m = kNone;   ///< where the known ends
};

/// The 3-D map around the vehicle, seen from above as it flies: level, and by directions from its
/// nose. So it holds what the camera saw before and does not see now.
struct ObstacleRing {
  std::array<SectorView, kSectors> sectors{};
};

/// Looks around. A voxel is in the way if it lies at the height of the body or of the margin around
/// it; a tilted body is taller. It counts for each direction that it covers a part of, at its point
/// nearest to the body's origin, horizontally. Only at the height of the body itself, without the
/// margin, must space be known to be called so. What lies outside the map's window is
/// unknown, and what is occupied the map's own thresholds say.
///
/// The directions are those of the nose in the horizontal plane: autopilots turn with the heading
/// alone and push the vehicle sideways, however it tilts.
/// REQUIRES: lengths not negative, max_m > 0. Cost: O((max_m / voxel_m)^2); does not allocate.
[[nodiscard]] ObstacleRing look_around(const MapSnapshot& map,
                                       const Transform<World, Body>& T_world_body,
                                       const RingOptions& options);

}  // namespace swiftlet::mavlink
