// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "swiftlet/integrate/block_evidence.hpp"
#include "swiftlet/map/block_window.hpp"

namespace swiftlet {

/// The cubes of 4 x 4 x 4 blocks of a window that a frame says something about, nearest first. Most
/// of a window is not in view: cubes are judged before their blocks.
class ViewCubes {
 public:
  /// Allocates only while windows grow.
  void find(const BlockWindow& window, const CubeView& view, const FrameEvidence& frame);

  [[nodiscard]] std::size_t size() const { return cubes_.size(); }
  /// Blocks of a cube that lie in the window.
  [[nodiscard]] std::size_t blocks_of(std::size_t cube) const {
    return cubes_[cube].blocks.block_count();
  }
  /// Calls visit(BlockIndex, Verdict) for the blocks of a cube that the frame says something about.
  template <class Visit>
  void for_each_block(std::size_t cube, const CubeView& view, const FrameEvidence& frame,
                      Visit&& visit) const {
    const Cube& c = cubes_[cube];
    swiftlet::for_each_block(c.blocks, [&](const BlockIndex& index) {
      const Verdict verdict = c.verdict == Verdict::kFree
                                  ? c.verdict
                                  : frame.judge(view.cube(first_voxel(index), kBlockEdge));
      if (verdict != Verdict::kNothing) visit(index, verdict);
    });
  }

  [[nodiscard]] std::size_t memory_bytes() const { return cubes_.capacity() * sizeof(Cube); }

 private:
  struct Cube {
    BlockWindow blocks;
    Verdict verdict;
    float distance2_m2;  // of its middle, from the camera
  };
  std::vector<Cube> cubes_;
};

}  // namespace swiftlet
