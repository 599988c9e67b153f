// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/projective/view_calculator.hpp"

namespace swiftlet {

void ViewCalculator::find(const BlockWindow& window, const CubeView& view,
                          const FrameEvidence& frame) {
  cubes_.clear();
  const BlockIndex end = window.end();
  BlockIndex b;
  for (b.z = window.first.z; b.z < end.z; b.z += kCube) {
    for (b.y = window.first.y; b.y < end.y; b.y += kCube) {
      constexpr std::int32_t kRow = kCube * static_cast<std::int32_t>(CubeBatch::kMost);
      for (b.x = window.first.x; b.x < end.x; b.x += kRow)
        find_in_row(b, {std::min(b.x + kRow, end.x), end.y, end.z}, view, frame);
    }
  }
  std::ranges::sort(cubes_, {}, &FrustumBlocks::distance2_m2);
}

void ViewCalculator::find_in_row(BlockIndex b, const BlockIndex& end, const CubeView& view,
                                 const FrameEvidence& frame) {
  CubeBatch batch;
  std::array<CubeInView, CubeBatch::kMost> cubes;
  const std::int32_t first = b.x;
  for (; b.x < end.x; b.x += kCube) {
    const CubeInView cube = view.cube(first_voxel(b), kCube * kBlockEdge);
    batch.half_camera = cube.half_camera;
    cubes[batch.count] = cube;
    batch.add(cube.p_camera);
  }
  UpdateTypes types;
  frame.intersect(batch, types);
  b.x = first;
  for (std::size_t i = 0; i < batch.count; ++i, b.x += kCube) {
    if (types[i] == UpdateType::kUnobserved) continue;
    const BlockIndex size{std::min(kCube, end.x - b.x), std::min(kCube, end.y - b.y),
                          std::min(kCube, end.z - b.z)};
    const Float3& p = cubes[i].p_world;
    cubes_.push_back({{b, size}, types[i], dot(p, p)});
  }
}

}  // namespace swiftlet
