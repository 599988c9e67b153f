// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

namespace swiftlet {

/// A place of a path that is being flown, and the room there.
struct CoursePoint {
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();
  double clearance_m = 0.0;  ///< to the nearest voxel that is not free, as far as it is known
};

/// A piece of the frontier.
struct CourseFrontier {
  Eigen::Vector3d centroid_m = Eigen::Vector3d::Zero();  ///< [world]
  std::uint32_t voxels = 0;
};

/// What a planner is at, as it stands after a frame: to be shown over the map.
struct Course {
  std::uint64_t frame_count = 0;              ///< of the map that it goes by
  std::optional<Eigen::Vector3d> goal_m;      ///< where the vehicle is to be in the end [world]
  std::optional<Eigen::Vector3d> target_m;    ///< where the path leads [world]
  std::optional<Eigen::Vector3d> looks_at_m;  ///< what is to be seen from there [world]
  std::vector<CoursePoint> path;              ///< from the vehicle on
  std::vector<CourseFrontier> frontier;
};

}  // namespace swiftlet
