// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <optional>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/query/sweep/body_shape.hpp"
#include "swiftlet/query/voxel_counts.hpp"

namespace swiftlet {

/// What a region holds.
struct RegionVoxels {
  VoxelCounts counts;     ///< by state
  bool is_inside = true;  ///< false: a part of it lies outside the window, where nothing is counted
  /// The voxel that is not free and nearest, by its centre, to the origin of the region's frame
  /// (the tip of a cone).
  std::optional<VoxelIndex> first_not_free;

  /// Whether all of it is known to be free.
  [[nodiscard]] bool is_free() const {
    return is_inside && counts.unknown == 0 && counts.occupied == 0;
  }
};

/// A cone with a flat end: a lamp's light, a landing's funnel.
struct ConeRegion {
  Eigen::Vector3d tip_world = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector3d axis_world = Eigen::Vector3d::UnitX();  ///< any length but 0
  double half_angle_rad = 0.5;                            ///< above 0, below pi / 2
  double length_m = 1.0;                                  ///< along the axis
};

/// The voxels that a sphere, capsule, box or union at a pose touches; of a union, those of each
/// part. Conservative and as tight as sweep(). Errors: kUsage, as sweep(). Cost: voxels of the
/// region. Does not allocate, unless it fails.
[[nodiscard]] Expected<RegionVoxels> voxels_in_body(const MapSnapshot& map, const BodyShape& body,
                                                    const Transform<World, Body>& T_world_body,
                                                    const OccupancyThresholds& thresholds = {});

/// The voxels that a cone touches, and those beside it by less than half a voxel's diagonal: a
/// voxel is taken for the ball around it. Errors: kUsage if a number cannot be used.
[[nodiscard]] Expected<RegionVoxels> voxels_in_cone(const MapSnapshot& map, const ConeRegion& cone,
                                                    const OccupancyThresholds& thresholds = {});

}  // namespace swiftlet
