// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "swiftlet/query/map_summary.hpp"
#include "swiftlet/render/coarser_map.hpp"
#include "swiftlet/render/projection.hpp"

// A projection is one file, which ends in draw_<name>(), and one line here.
#define SWIFTLET_MAP_VIEWS(X)                                                                \
  X(top, "from above: occupied columns dark, the more voxels the darker; free columns pale") \
  X(slice, "the layer at height --z: occupied blue, free yellow, unknown white")             \
  X(height, "from above: the highest occupied voxel of every column, coloured by height")    \
  X(iso, "in three dimensions: occupied voxels coloured by height, shaded, over pale free floor")

namespace swiftlet::render {

#define SWIFTLET_DECLARE(name, summary) \
  Picture draw_##name(const BlockMap& map, const VoxelBox& box, const ProjectionOptions& options);
SWIFTLET_MAP_VIEWS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const Registered<DrawProjection>> projections() {
#define SWIFTLET_LINE(name, summary) Registered<DrawProjection>{#name, summary, draw_##name},
  static constexpr std::array kProjections{SWIFTLET_MAP_VIEWS(SWIFTLET_LINE)};
#undef SWIFTLET_LINE
  return kProjections;
}

namespace {

constexpr double kMaxMegapixels = 64.0;  // the isometric projection takes 15 bytes for each
constexpr double kFitting_px = 1600.0;
constexpr double kMargins_px = 56.0;
constexpr double kMostVoxels = 9e6;     // that are drawn one by one if nobody asks for more
constexpr double kLongestSide = 16384;  // likewise [voxels]
constexpr int kMostJoined = 512;

/// The sides of the largest picture of a box, in voxels. Doubles: a box may be wider than an int.
struct Sides {
  double width, height;
};
Sides plan_sides(const VoxelBox& box) {
  return {1.0 + box.last.y - box.first.y, 1.0 + box.last.x - box.first.x};
}
Sides iso_sides(const VoxelBox& box) {
  const auto [y, x] = plan_sides(box);
  return {(x + y) * 0.87, (x + y) * 0.5 + 1.0 + box.last.z - box.first.z};
}

/// No side of a picture is longer than this, in voxels.
double wide_voxels(const VoxelBox& box) {
  const auto [a, b] = plan_sides(box);
  const auto [c, d] = iso_sides(box);
  return std::max({a, b, c, d});
}

double megapixels(const VoxelBox& box, double voxel_px, double margins_px) {
  const auto of = [&](const Sides& s) {
    return (s.width * voxel_px + margins_px) * (s.height * voxel_px + margins_px) * 1e-6;
  };
  return std::max(of(plan_sides(box)), of(iso_sides(box)));
}

int fitting_voxel_px(const VoxelBox& box) {
  return static_cast<int>(std::clamp(kFitting_px / wide_voxels(box), 1.0, 32.0));
}

int joined_voxels_of(const VoxelBox& box, const ProjectionOptions& options) {
  if (options.voxel_px != 0) return 1;
  const double voxels = megapixels(box, 1.0, 0.0) * 1e6;
  const double joined =
      std::ceil(std::max({1.0, std::sqrt(voxels / kMostVoxels), wide_voxels(box) / kLongestSide}));
  return joined > kMostJoined ? 0 : static_cast<int>(joined);
}

Error no_picture(const VoxelBox& box, double voxel_m) {
  return {ErrorCode::kUsage,
          {},
          fmt::format("the map is {:.3g} m wide in voxels of {} m: no picture shows that",
                      wide_voxels(box) * voxel_m, voxel_m),
          "'swiftlet info' tells its bounds; is there a stray block?"};
}

}  // namespace

int joined_voxels(const BlockMap& map, const ProjectionOptions& options) {
  const auto box = summarize(map).bounds;
  return box ? joined_voxels_of(*box, options) : 1;
}

Expected<Picture> draw_projection(std::string_view projection, const BlockMap& map,
                                  const ProjectionOptions& options) {
  auto known = find_registered(projections(), projection, "projection");
  if (!known) return forward_error(std::move(known));
  const auto box = summarize(map).bounds;
  if (!box) {
    return fail(ErrorCode::kNotFound, {}, "the map holds no free or occupied voxel to draw",
                "look at it with 'swiftlet info'");
  }
  const int joined = joined_voxels_of(*box, options);
  if (joined == 0) return tl::make_unexpected(no_picture(*box, map.voxel_m()));
  if (joined > 1) {
    const BlockMap small = coarser_map(map, joined);
    return draw_projection(
        projection, small,
        {options.z_m, fitting_voxel_px(summarize(small).bounds.value_or(*box)), options.path});
  }
  ProjectionOptions fitted = options;
  if (fitted.voxel_px == 0) fitted.voxel_px = fitting_voxel_px(*box);
  const double size = megapixels(*box, fitted.voxel_px, kMargins_px);
  if (size > kMaxMegapixels) {
    return fail(ErrorCode::kUsage, "--scale",
                fmt::format("the picture could have {:.0f} megapixels", size),
                "choose fewer pixels per voxel");
  }
  return known->make(map, *box, fitted);
}

}  // namespace swiftlet::render
