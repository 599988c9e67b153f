// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>

#include "swiftlet/render/floor_plan.hpp"

namespace swiftlet::render {
namespace {

constexpr double kFullHeight_m = 1.5;  // a column with this much matter is drawn darkest

}  // namespace

/// Walls stand out dark against tables and chairs, since they fill more voxels of their columns.
Picture draw_top(const BlockMap& map, const VoxelBox& whole, const ProjectionOptions& options) {
  const VoxelBox box = cut_box(whole, map.voxel_m(), options);
  FloorPlan plan(map, box, options.voxel_px);
  const Columns columns(map, box);
  for_each_column(box, [&](std::int32_t x, std::int32_t y) {
    const Column column = columns.at(x, y);
    Colour colour = column.free > 0 ? kFreeGround : kUnseen;
    if (column.occupied > 0) {
      const double matter = std::min(1.0, column.occupied * map.voxel_m() / kFullHeight_m);
      colour = shaded({120, 150, 190}, 1.0 - 0.85 * matter);
    }
    plan.fill_column(x, y, colour);
  });
  return std::move(plan).finish(options);
}

}  // namespace swiftlet::render
