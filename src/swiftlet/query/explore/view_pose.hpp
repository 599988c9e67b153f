// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/query/explore/frontier_clusters.hpp"
#include "swiftlet/query/explore/view_camera.hpp"
#include "swiftlet/query/sweep/sweep.hpp"

namespace swiftlet {

/// Where to look from, level, and how much of it is seen there.
struct ViewPose {
  Transform<World, Body> T_world_body;  ///< level, where the body has room
  std::size_t voxels_seen = 0;          ///< of those that were tried
  std::size_t voxels_tried = 0;         ///< of a large cluster, some that are spread evenly over it
};

/// The body at a place, level, turned to the left by `yaw_rad`.
[[nodiscard]] Transform<World, Body> level_pose(const Eigen::Vector3d& p_world, double yaw_rad);

/// How many of these voxels the camera sees from a pose: in the image, within range, and with only
/// free voxels on the way. REQUIRES: voxels inside the window.
[[nodiscard]] std::size_t voxels_in_sight(const MapSnapshot& map,
                                          std::span<const VoxelIndex> voxels,
                                          const Transform<World, Camera>& T_world_camera,
                                          const ViewCamera& camera,
                                          const OccupancyThresholds& thresholds);

/// A pose in which the body is clear and the camera sees most of a cluster, the voxels tried one by
/// one by rays; nullopt if no candidate sees any. Candidates stand around the cluster at three
/// distances and heights, those that its normal points away from first; whether there is a way to
/// them is for the planner to find out.
/// Errors: kUsage if the camera is not sound; as sweep(). Cost: up to 144 places and 32 rays each.
[[nodiscard]] Expected<std::optional<ViewPose>> find_view(
    const MapSnapshot& map, const FrontierCluster& cluster, std::span<const VoxelIndex> voxels,
    const ViewCamera& camera, const BodyShape& body, const SweepPolicy& policy = {});

}  // namespace swiftlet
