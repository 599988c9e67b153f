// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "swiftlet/integrate/projective/block_evidence.hpp"
#include "swiftlet/map/block_window.hpp"

namespace swiftlet {

/// The cubes of 4 x 4 x 4 blocks of a window that a frame says something about, nearest first. Most
/// of a window is not in view: cubes are looked at before their blocks.
class ViewCalculator {
 public:
  /// Allocates only while windows grow.
  void find(const BlockWindow& window, const CubeView& view, const FrameEvidence& frame);

  [[nodiscard]] std::size_t size() const { return cubes_.size(); }
  /// Blocks of a cube that lie in the window.
  [[nodiscard]] std::size_t blocks_of(std::size_t cube) const {
    return cubes_[cube].blocks.block_count();
  }
  /// Calls visit(BlockIndex, UpdateType) for the blocks of a cube that the frame says something
  /// about.
  template <class Visit>
  void for_each_block(std::size_t cube, const CubeView& view, const FrameEvidence& frame,
                      Visit&& visit) const {
    const FrustumBlocks& c = cubes_[cube];
    const CubeInView whole = view.cube(first_voxel(c.blocks.first), kCube * kBlockEdge);
    OctantUpdates octants, blocks;
    frame.intersect_octants(whole, kCube / 2 * kBlockEdge, c.type, octants);
    for (int i = 0; i < 8; ++i) {
      const auto half = static_cast<std::size_t>(i);
      const UpdateType type = octants.types[half];
      if (type == UpdateType::kUnobserved) continue;
      frame.intersect_octants(octants.cubes[half], kBlockEdge, type, blocks);
      for (int k = 0; k < 8; ++k) {
        const BlockIndex place{2 * (i & 1) + (k & 1), (i & 2) + ((k >> 1) & 1),
                               2 * (i >> 2) + (k >> 2)};
        const BlockIndex index{c.blocks.first.x + place.x, c.blocks.first.y + place.y,
                               c.blocks.first.z + place.z};
        const UpdateType of_block = blocks.types[static_cast<std::size_t>(k)];
        if (of_block != UpdateType::kUnobserved && c.blocks.contains(index)) visit(index, of_block);
      }
    }
  }

  [[nodiscard]] std::size_t memory_bytes() const {
    return cubes_.capacity() * sizeof(FrustumBlocks);
  }

 private:
  static constexpr std::int32_t kCube = 4;  // blocks

  struct FrustumBlocks {
    BlockWindow blocks;  // of the window
    UpdateType type;
    float distance2_m2;  // of its middle, from the camera
  };
  void find_in_row(BlockIndex b, const BlockIndex& end, const CubeView& view,
                   const FrameEvidence& frame);

  std::vector<FrustumBlocks> cubes_;
};

}  // namespace swiftlet
