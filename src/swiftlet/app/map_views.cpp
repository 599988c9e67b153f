// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "swiftlet/app/map_view.hpp"

// A view is one file, which ends in draw_<name>(), and one line here.
#define SWIFTLET_MAP_VIEWS(X)                                                               \
  X(top, "from above: occupied columns dark, the more cells the darker; free columns pale") \
  X(slice, "the layer at height --z: occupied blue, free yellow, unknown white")            \
  X(height, "from above: the highest occupied cell of every column, coloured by height")    \
  X(iso, "in three dimensions: occupied cells coloured by height, shaded, over pale free floor")

namespace swiftlet::app {

#define SWIFTLET_DECLARE(name, summary) \
  Picture draw_##name(const LoadedMap& map, const VoxelBox& box, const ViewOptions& options);
SWIFTLET_MAP_VIEWS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const Registered<DrawView>> map_views() {
#define SWIFTLET_LINE(name, summary) Registered<DrawView>{#name, summary, draw_##name},
  static constexpr std::array kViews{SWIFTLET_MAP_VIEWS(SWIFTLET_LINE)};
#undef SWIFTLET_LINE
  return kViews;
}

namespace {

constexpr double kMaxMegapixels = 200.0;
constexpr double kFitting_px = 1600.0;

/// No side of a picture is longer than this, in cells. A double: a box may be wider than an int.
double wide_cells(const VoxelBox& box) {
  const auto side = [](std::int32_t first, std::int32_t last) { return 1.0 + last - first; };
  const double x = side(box.first.x, box.last.x);
  const double y = side(box.first.y, box.last.y);
  return std::max({x, y, (x + y) * 0.87, (x + y) * 0.5 + side(box.first.z, box.last.z)});
}

int fitting_cell_px(const VoxelBox& box) {
  return static_cast<int>(std::clamp(kFitting_px / wide_cells(box), 1.0, 32.0));
}

}  // namespace

Expected<Picture> draw_view(std::string_view view, const LoadedMap& map,
                            const ViewOptions& options) {
  auto known = find_registered(map_views(), view, "view");
  if (!known) return forward_error(std::move(known));
  const auto box = known_box(map);
  if (!box) {
    return fail(ErrorCode::kNotFound, {}, "the map holds no free or occupied cell to draw",
                "look at it with 'swiftlet info'");
  }
  ViewOptions fitted = options;
  if (fitted.cell_px == 0) fitted.cell_px = fitting_cell_px(*box);
  const double megapixels =
      wide_cells(*box) * wide_cells(*box) * fitted.cell_px * fitted.cell_px * 1e-6;
  if (megapixels > kMaxMegapixels) {
    return fail(ErrorCode::kUsage, "--scale",
                fmt::format("the picture could have {:.0f} megapixels", megapixels),
                "choose fewer pixels per cell");
  }
  return known->make(map, *box, fitted);
}

}  // namespace swiftlet::app
