// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/grid_ray.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace swiftlet {

Clip clip_to_box(const GridRay& ray, const VoxelBox& box) {
  Clip clip;
  const Eigen::Array3d low(box.first.x, box.first.y, box.first.z);
  const Eigen::Array3d high(box.last.x + 1.0, box.last.y + 1.0, box.last.z + 1.0);
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const double from = ray.from[axis];
    const double direction = ray.to[axis] - from;
    if (direction == 0.0) {
      const bool is_inside = from >= low[axis] && from < high[axis];
      if (!is_inside) return {1.0, 0.0};
      continue;
    }
    const double t_low = (low[axis] - from) / direction;
    const double t_high = (high[axis] - from) / direction;
    clip.begin = std::max(clip.begin, std::min(t_low, t_high));
    clip.end = std::min(clip.end, std::max(t_low, t_high));
  }
  return clip;
}

GridWalk::Axis GridWalk::make_axis(double from, double to, const Clip& clip, std::int32_t low,
                                   std::int32_t high) {
  const auto voxel_at = [&](double t) {
    const double p = t >= 1.0 ? to : from + t * (to - from);  // the very end, not its rounding
    return std::clamp(static_cast<std::int32_t>(std::floor(p)), low, high);
  };
  const std::int32_t first = voxel_at(clip.begin);
  const std::int32_t last = voxel_at(clip.end);
  return {from, 1.0 / (to - from), first, last >= first ? 1 : -1, std::abs(last - first)};
}

GridWalk::GridWalk(const GridRay& ray, const VoxelBox& box, const Clip& clip)
    : axes_{make_axis(ray.from.x(), ray.to.x(), clip, box.first.x, box.last.x),
            make_axis(ray.from.y(), ray.to.y(), clip, box.first.y, box.last.y),
            make_axis(ray.from.z(), ray.to.z(), clip, box.first.z, box.last.z)},
      crossing_{axes_[0].next_crossing(), axes_[1].next_crossing(), axes_[2].next_crossing()},
      entered_at_(clip.begin) {}

}  // namespace swiftlet
