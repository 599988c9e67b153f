// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>

#include "swiftlet/integrate/cell_kernels.hpp"
#include "swiftlet/integrate/depth_pyramid.hpp"
#include "swiftlet/integrate/reading_tiles.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// What a frame can say about a cube of cells.
enum class Verdict : std::uint8_t {
  kNothing,  ///< out of view, without readings, or hidden behind them
  kFree,     ///< every pixel of its image has a reading that passes it
  kSeen,     ///< every reading of its image passes it; some pixels have none
  kMixed,    ///< may hold a surface, or is too near to tell
};

/// Where the evidence of one block is put together.
struct BlockEvidence {
  std::array<FixedSteps, kBlockVoxels> steps;
  CellList passed, sampled;
};

/// What one frame says about blocks of the map, cube by cube: where the depth image says the same
/// about all of a cube, its cells get it at once; elsewhere the cube is halved, down to single
/// cells, which look at the readings of their image.
class FrameEvidence {
 public:
  FrameEvidence(const CubeView& view, const DepthPyramid& pyramid,
                const ReadingSummaries& summaries, const EvidenceTable& table,
                const FrameInView& frame, std::uint64_t frame_number);

  [[nodiscard]] Verdict judge(const CubeInView& cube) const;

  /// The evidence for a block that was judged so. Cells that `known` shows to be surely free may be
  /// left out where they are free. False if there is none.
  bool collect(const BlockIndex& index, Verdict verdict, const VoxelBlock* known,
               BlockEvidence& evidence) const;

 private:
  /// Nearer than so many cells, the formula for the area of a cell's image is too rough.
  static constexpr float kNearCells = 4.0F;

  struct Work;
  void descend(const CubeInView& cube, int edge, int offset, Verdict verdict, Work& work) const;
  void look(const CubeInView& cube, Work& work) const;
  [[nodiscard]] CellCube cells_of(const CubeInView& cube, int edge, int offset) const;

  const CubeView& view_;
  const DepthPyramid& pyramid_;
  const ReadingSummaries& summaries_;
  const EvidenceTable& table_;
  const FrameInView& frame_;
  std::uint64_t frame_number_;
  float slice_inset_m_;  // from the nearest point of a cell's cube to the nearest of its slice
};

}  // namespace swiftlet
