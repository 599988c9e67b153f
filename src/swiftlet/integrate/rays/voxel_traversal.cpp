// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/rays/ray_method.hpp"

namespace swiftlet {

/// Method 5, Algorithm 2 (Amanatides & Woo 1987): every voxel that the ray crosses.
std::size_t trace_voxel_traversal(const GridRay& ray, const VoxelBox& box,
                                  std::span<VoxelIndex> out) {
  const Clip clip = clip_to_box(ray, box);
  if (clip.is_empty()) return 0;
  GridWalk walk(ray, box, clip);
  std::size_t count = 0;
  do {
    out[count++] = walk.voxel();
  } while (walk.advance());
  return count;
}

}  // namespace swiftlet
