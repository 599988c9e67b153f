// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/render/floor_plan.hpp"

namespace swiftlet::render {

/// The thesis's 2-D map (method 10): the camera-height layer where the flight began,
/// unless told otherwise.
Picture draw_slice(const BlockMap& map, const VoxelBox& box, const ProjectionOptions& options) {
  const double start_z_m = map.header().start_m.value_or(Eigen::Vector3d::Zero()).z();
  const std::int32_t z = layer_at(options.z_m.value_or(start_z_m), map.voxel_m());
  FloorPlan plan(map, box, options.voxel_px);
  constexpr Colour kYellow{255, 226, 89}, kBlue{31, 73, 160};
  for_each_column(box, [&](std::int32_t x, std::int32_t y) {
    const Occupancy voxel = map.occupancy(VoxelIndex{x, y, z});
    const Colour known = voxel == Occupancy::kOccupied ? kBlue : kYellow;
    plan.fill_column(x, y, voxel == Occupancy::kUnknown ? kPaper : known);
  });
  return std::move(plan).finish(options);
}

}  // namespace swiftlet::render
