// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/thin_cells.hpp"

#include <algorithm>

namespace swiftlet::eval {

std::vector<ThinCell> thin_cells(const Truth& truth) {
  std::vector<ThinCell> cells;
  truth.cells().for_each([&](const VoxelIndex& v, const CellTruth& cell) {
    if (cell.holds != Holds::kSolid) return;
    const auto* c = std::get_if<sim::Cylinder>(&truth.objects()[cell.object].shape);
    if (c == nullptr || c->diameter_m > kThinnest_m || c->diameter_m >= truth.voxel_m()) return;
    const Eigen::Vector3d axis = c->to_m - c->from_m;
    const Eigen::Vector3d middle = centre_of(v, truth.voxel_m());
    const double t = std::clamp((middle - c->from_m).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    cells.push_back({v, c->diameter_m, (c->from_m + t * axis).cast<float>(), 0.0F});
  });
  std::ranges::stable_sort(cells, {}, &ThinCell::diameter_m);
  return cells;
}

#if SWIFTLET_HAS_EMBREE

void look_at(std::vector<ThinCell>& cells, const sim::RayCaster& world, const TrueView& view,
             const SightOptions& options) {
  std::vector<Eigen::Vector3f> points;
  std::vector<float> depths;
  for (auto first = cells.begin(); first != cells.end();) {
    const auto last = std::find_if(
        first, cells.end(), [&](const ThinCell& c) { return c.diameter_m != first->diameter_m; });
    points.clear();
    for (auto cell = first; cell != last; ++cell) points.push_back(cell->point_m);
    depths.resize(points.size());
    depths_in_view(world, view, options, points, static_cast<float>(0.5 * first->diameter_m),
                   depths);
    for (auto cell = first; cell != last; ++cell) {
      const float z_m = depths[static_cast<std::size_t>(cell - first)];
      if (z_m > 0.0F && (cell->nearest_m == 0.0F || z_m < cell->nearest_m)) cell->nearest_m = z_m;
    }
    first = last;
  }
}

#endif

}  // namespace swiftlet::eval
