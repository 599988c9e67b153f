// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Question: how far is the nearest obstacle, and which way is away from it, while mapping goes on?

#include <cstdio>
#include <thread>

#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/query/distance/distance_field_thread.hpp"

namespace {

/// A wall 1 m ahead with free space before it, as a mapper would have found it.
void map_a_wall(swiftlet::RollingMap& map) {
  for (int x = -20; x <= 10; ++x) {
    for (int y = -15; y <= 15; ++y) {
      for (int z = -15; z <= 15; ++z) {
        const swiftlet::VoxelIndex voxel{x, y, z};
        map.writable(swiftlet::block_of(voxel)).voxels[swiftlet::offset_in_block(voxel)] =
            x == 10 ? swiftlet::kOccupiedVoxel : swiftlet::kFreeVoxel;
      }
    }
  }
}

}  // namespace

int main() {
  auto map = swiftlet::RollingMap::create({.voxel_m = 0.1, .size_m = {8, 8, 4}});
  map->recentre({0, 0, 0}, nullptr);
  // Its own thread, from a reader of the map; with a Mapper, mapper.reader() and mapper.map().
  auto fields = swiftlet::DistanceFieldThread::start(map->reader(), map->voxel_m(),
                                                     map->window().size, {.max_distance_m = 1.5});
  if (!fields) {
    std::fprintf(stderr, "%s\n", fields.error().text().c_str());
    return 2;
  }
  map_a_wall(*map);
  map->publish({3});  // Mapper::integrate() does this after every frame

  for (;;) {  // the planner's thread: always a whole field
    const auto field = fields->latest();
    if (!field || (*field)->frame_count() < 3) {
      std::this_thread::yield();
      continue;
    }
    const Eigen::Vector3d here(0.45, 0.05, 0.05);
    const auto sample = (*field)->sample(here, swiftlet::Obstacles::kNotFree);
    const auto voxel = swiftlet::voxel_containing(here, map->voxel_m());
    const auto wall = (*field)->closest_obstacle(voxel, swiftlet::Obstacles::kNotFree);
    if (sample.status != swiftlet::DistanceStatus::kKnown || !wall) return 1;
    const Eigen::Vector3d at = swiftlet::centre_of(*wall, map->voxel_m());
    std::printf("frame %d: %.2f m to the wall at %.2f %.2f %.2f; fly along %.2f %.2f %.2f\n",
                static_cast<int>((*field)->frame_count()), sample.distance_m, at.x(), at.y(),
                at.z(), sample.gradient.x(), sample.gradient.y(), sample.gradient.z());
    return 0;
  }
}
