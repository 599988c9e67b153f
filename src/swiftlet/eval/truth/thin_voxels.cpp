// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/thin_voxels.hpp"

#include <algorithm>

namespace swiftlet::eval {

std::vector<ThinVoxel> thin_voxels(const Truth& truth) {
  std::vector<ThinVoxel> voxels;
  truth.voxels().for_each([&](const VoxelIndex& v, const VoxelTruth& voxel) {
    if (voxel.holds != Holds::kSolid) return;
    const auto* c = std::get_if<sim::Cylinder>(&truth.objects()[voxel.object].shape);
    if (c == nullptr || c->diameter_m > kThinnest_m || c->diameter_m >= truth.voxel_m()) return;
    const Eigen::Vector3d axis = c->to_m - c->from_m;
    const Eigen::Vector3d middle = centre_of(v, truth.voxel_m());
    const double t = std::clamp((middle - c->from_m).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
    voxels.push_back({v, c->diameter_m, (c->from_m + t * axis).cast<float>(), 0.0F});
  });
  std::ranges::stable_sort(voxels, {}, &ThinVoxel::diameter_m);
  return voxels;
}

#if SWIFTLET_HAS_EMBREE

void look_at(std::vector<ThinVoxel>& voxels, const sim::RayCaster& world, const TrueView& view,
             const SightOptions& options) {
  std::vector<Eigen::Vector3f> points;
  std::vector<float> depths;
  for (auto first = voxels.begin(); first != voxels.end();) {
    const auto last = std::find_if(
        first, voxels.end(), [&](const ThinVoxel& c) { return c.diameter_m != first->diameter_m; });
    points.clear();
    for (auto voxel = first; voxel != last; ++voxel) points.push_back(voxel->point_m);
    depths.resize(points.size());
    depths_in_view(world, view, options, points, static_cast<float>(0.5 * first->diameter_m),
                   depths);
    for (auto voxel = first; voxel != last; ++voxel) {
      const float z_m = depths[static_cast<std::size_t>(voxel - first)];
      if (z_m > 0.0F && (voxel->nearest_m == 0.0F || z_m < voxel->nearest_m))
        voxel->nearest_m = z_m;
    }
    first = last;
  }
}

#endif

}  // namespace swiftlet::eval
