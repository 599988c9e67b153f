// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/map/map_window.hpp"

#include <fmt/format.h>

namespace swiftlet {
Expected<RollingMap> window_of(const BlockMap& map) {
  constexpr double kMostBlocks = 2e6;  // 1 GB, and a distance field beside it
  if (map.block_count() == 0)
    return fail(ErrorCode::kNotFound, {}, "the map holds nothing", "choose a map that was flown");
  const BlockWindow& box = map.extent();
  const Eigen::Array3d first(box.first.x, box.first.y, box.first.z);
  const Eigen::Array3d blocks(box.size.x, box.size.y, box.size.z);
  const double block_m = kBlockEdge * map.voxel_m();
  if (blocks.prod() > kMostBlocks) {
    return fail(ErrorCode::kUnsupported, {},
                fmt::format("the map spans {:.0f} x {:.0f} x {:.0f} m, too much to plan on at once",
                            blocks.x() * block_m, blocks.y() * block_m, blocks.z() * block_m),
                "is there a stray block? look at the map's bounds");
  }
  RollingMap::Options options{map.voxel_m(), (blocks + 1.0) * block_m, {}};
  options.trigger_m = 0.25 * options.size_m;
  auto window = RollingMap::create(options, map.scale());
  if (!window) return window;
  window->recentre((first + 0.5 * blocks) * block_m, nullptr);
  map.for_each_known_block(
      [&](const BlockIndex& index, const VoxelBlock& block) { window->writable(index) = block; });
  return window;
}

}  // namespace swiftlet
