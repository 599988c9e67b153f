// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/view_cubes.hpp"

namespace swiftlet {
namespace {

constexpr std::int32_t kCube = 4;  // blocks

}  // namespace

void ViewCubes::find(const BlockWindow& window, const CubeView& view, const FrameEvidence& frame) {
  cubes_.clear();
  const BlockIndex end = window.end();
  BlockIndex b;
  for (b.z = window.first.z; b.z < end.z; b.z += kCube) {
    for (b.y = window.first.y; b.y < end.y; b.y += kCube) {
      for (b.x = window.first.x; b.x < end.x; b.x += kCube) {
        const CubeInView cube = view.cube(first_voxel(b), kCube * kBlockEdge);
        const Verdict verdict = frame.judge(cube);
        if (verdict == Verdict::kNothing) continue;
        const BlockIndex size{std::min(kCube, end.x - b.x), std::min(kCube, end.y - b.y),
                              std::min(kCube, end.z - b.z)};
        cubes_.push_back({{b, size}, verdict, dot(cube.p_world, cube.p_world)});
      }
    }
  }
  std::ranges::sort(cubes_, {}, &Cube::distance2_m2);
}

}  // namespace swiftlet
