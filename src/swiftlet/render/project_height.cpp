// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>

#include "swiftlet/render/floor_plan.hpp"

namespace swiftlet::render {

Picture draw_height(const BlockMap& map, const VoxelBox& whole, const ProjectionOptions& options) {
  const VoxelBox box = cut_box(whole, map.voxel_m(), options);
  const std::int32_t low = lowest_matter(map, box).value_or(box.first.z);
  const int span = std::max(1, box.last.z - low);
  FloorPlan plan(map, box, options.voxel_px);
  const Columns columns(map, box);
  for_each_column(box, [&](std::int32_t x, std::int32_t y) {
    const Column column = columns.at(x, y);
    const double height = static_cast<double>(column.highest - low) / span;
    const Colour empty = column.free > 0 ? kFreeGround : kUnseen;
    plan.fill_column(x, y, column.occupied > 0 ? height_colour(height) : empty);
  });
  return std::move(plan).finish(options);
}

}  // namespace swiftlet::render
