// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <cmath>

#include "swiftlet/integrate/rays/ray_method.hpp"

namespace swiftlet {

/// Method 5, Algorithm 1 with its errata: steps of one voxel along the dominant axis, v = ray / max
/// |ray_i|, which needs no slope and no sign; the end point is always visited.
std::size_t trace_line_drawing(const GridRay& ray, const VoxelBox& box, std::span<VoxelIndex> out) {
  const Clip clip = clip_to_box(ray, box);
  if (clip.is_empty()) return 0;
  const Eigen::Vector3d direction = ray.to - ray.from;
  const double longest = direction.cwiseAbs().maxCoeff();
  const Eigen::Vector3d step = direction / longest;  // exactly 1 along the dominant axis

  std::size_t count = 0;
  const auto visit = [&](const Eigen::Vector3d& p) {
    const VoxelIndex voxel = voxel_containing(p, 1.0);
    if (box.contains(voxel) && (count == 0 || out[count - 1] != voxel)) out[count++] = voxel;
  };
  const auto first_step = static_cast<std::int64_t>(std::ceil(clip.begin * longest));
  const auto last_step = static_cast<std::int64_t>(std::ceil(clip.end * longest)) - 1;
  for (std::int64_t i = first_step; i <= last_step; ++i) {
    visit(ray.from + static_cast<double>(i) * step);
  }
  visit(clip.end >= 1.0 ? ray.to : Eigen::Vector3d(ray.from + clip.end * direction));
  return count;
}

}  // namespace swiftlet
