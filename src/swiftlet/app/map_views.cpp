// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <array>
#include <cmath>

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

Expected<Picture> draw_view(std::string_view name, const LoadedMap& map,
                            const ViewOptions& options) {
  constexpr double kMaxPixels = 200e6;
  auto view = find_registered(map_views(), name, "view");
  if (!view) return forward_error(std::move(view));
  const auto box = known_box(map);
  if (!box) {
    return fail(ErrorCode::kNotFound, {}, "the map holds no free or occupied cell to draw",
                "look at it with 'swiftlet info'");
  }
  // In doubles: a box may be wider than an int of pixels.
  const auto side_px = [&](std::int32_t first, std::int32_t last) {
    return (double{1} + last - first) * options.cell_px;
  };
  const double width = side_px(box->first.y, box->last.y) + side_px(box->first.x, box->last.x);
  const double height = width + side_px(box->first.z, box->last.z);
  if (width * height > kMaxPixels) {
    return fail(
        ErrorCode::kUsage, "--scale",
        fmt::format("the picture would have about {:.0f} megapixels", width * height * 1e-6),
        "choose fewer pixels per cell");
  }
  return view->make(map, *box, options);
}

}  // namespace swiftlet::app
