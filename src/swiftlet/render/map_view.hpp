// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <span>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/map/block_map.hpp"
#include "swiftlet/render/picture.hpp"

namespace swiftlet::render {

/// How a map is drawn.
struct ViewOptions {
  std::optional<double> z_m;  ///< slice: its height; others: what lies above is cut away [m, world]
  int cell_px = 0;            ///< edge of a cell in the picture; 0 for what fits 1600 pixels
};

/// Draws the cells of a map that lie inside a box which holds all that is known of it.
using DrawView = Picture (*)(const BlockMap& map, const VoxelBox& box, const ViewOptions& options);

/// All views there are.
[[nodiscard]] std::span<const Registered<DrawView>> map_views();

/// How many cells along each axis draw_view() draws as one, because the map is too wide to draw
/// each and the user has not chosen a scale: 1 for most maps. A cube that holds matter is drawn as
/// matter. 0: no picture shows it.
[[nodiscard]] int joined_cells(const BlockMap& map, const ViewOptions& options);

/// Draws a map. Errors: kUsage for an unknown view, a picture above 64 megapixels and a map that no
/// picture shows; kNotFound if the map holds no free or occupied cell to draw.
[[nodiscard]] Expected<Picture> draw_view(std::string_view view, const BlockMap& map,
                                          const ViewOptions& options);

}  // namespace swiftlet::render
