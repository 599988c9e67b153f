// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <span>
#include <vector>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/map/block_map.hpp"
#include "swiftlet/render/picture.hpp"

namespace swiftlet::render {

/// How a map is drawn.
struct ProjectionOptions {
  std::optional<double> z_m;  ///< slice: its height; others: what lies above is cut away [m, world]
  int voxel_px = 0;           ///< edge of a voxel in the picture; 0 for what fits 1600 pixels
  std::vector<Eigen::Vector3d> path{};  ///< drawn on pictures from above, with its end [m, world]
};

/// Draws the voxels of a map that lie inside a box which holds all that is known of it.
using DrawProjection = Picture (*)(const BlockMap& map, const VoxelBox& box,
                                   const ProjectionOptions& options);

/// All projections there are.
[[nodiscard]] std::span<const Registered<DrawProjection>> projections();

/// How many voxels along each axis draw_projection() draws as one, because the map is too wide to
/// draw each and the user has not chosen a scale: 1 for most maps. A cube that holds matter is
/// drawn as matter. 0: no picture shows it.
[[nodiscard]] int joined_voxels(const BlockMap& map, const ProjectionOptions& options);

/// Draws a map. Errors: kUsage for an unknown projection, a picture above 64 megapixels and a map
/// that no picture shows; kNotFound if the map holds no free or occupied voxel to draw.
[[nodiscard]] Expected<Picture> draw_projection(std::string_view projection, const BlockMap& map,
                                                const ProjectionOptions& options);

}  // namespace swiftlet::render
