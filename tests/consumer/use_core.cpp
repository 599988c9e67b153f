// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What a planner does first: chain two poses, write where it leads into a map, read it back from a
// snapshot.

#include <cstdlib>
#include <iostream>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/map/rolling_map.hpp"

using namespace swiftlet;

int main() {
  const auto T_world_body = Transform<World, Body>::from(
      Eigen::Quaterniond(Eigen::AngleAxisd(EIGEN_PI / 2, Eigen::Vector3d::UnitZ())), {1, 2, 3});
  auto map = RollingMap::create({.voxel_m = 0.1, .size_m = {8, 8, 4}});
  if (!T_world_body || !map) return EXIT_FAILURE;

  // One metre ahead of a camera that looks along the body's x axis, which points along world y
  // here.
  const Eigen::Vector3d p_world =
      *T_world_body * forward_looking_camera() * Eigen::Vector3d(0, 0, 1);
  if (!p_world.isApprox(Eigen::Vector3d(1, 3, 3), 1e-9)) return EXIT_FAILURE;

  map->recentre(T_world_body->translation(), nullptr);
  const VoxelIndex wall = voxel_containing(p_world + Eigen::Vector3d::Constant(0.05), 0.1);
  map->writable(block_of(wall)).voxels[offset_in_block(wall)] = kOccupiedVoxel;

  const auto snapshot = map->snapshot({1});
  const bool is_seen = snapshot && snapshot->log_odds(wall) == kOccupiedVoxel &&
                       snapshot->log_odds({wall.x, wall.y, wall.z + 1}) == kUnknownVoxel;
  std::cout << "wall at " << p_world.transpose() << (is_seen ? " is on the map\n" : " was lost\n");
  return is_seen ? EXIT_SUCCESS : EXIT_FAILURE;
}
