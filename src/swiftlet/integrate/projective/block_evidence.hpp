// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>

#include "swiftlet/integrate/image/depth_mean_pyramid.hpp"
#include "swiftlet/integrate/measurement_model.hpp"
#include "swiftlet/integrate/projective/range_image_intersector.hpp"
#include "swiftlet/integrate/projective/voxel_list.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// The eight octants of a cube, as CubeView::child() counts them, and what a frame says of each.
struct OctantUpdates {
  std::array<CubeInView, 8> cubes;
  UpdateTypes types;
};

/// Where the evidence of one block is put together.
struct BlockEvidence {
  std::array<FixedSteps, kBlockVoxels> steps;
  VoxelList passed, sampled;
};

/// What one frame says about blocks of the map, cube by cube: where the depth image says the same
/// about all of a cube, its voxels get it at once; elsewhere the cube is halved, down to single
/// voxels, which look at the readings of their image.
class FrameEvidence {
 public:
  FrameEvidence(const CubeView& view, const DepthView& depth, const DepthMeanPyramid& means,
                const MeasurementModel& model, const KernelParams& params);

  [[nodiscard]] std::uint64_t frame_number() const { return frame_number_; }

  void intersect(const CubeBatch& cubes, UpdateTypes& types) const {
    intersect_cubes(params_, tiles_, cubes, types);
  }
  /// The eight octants, `edge` voxels wide, of a cube of this type. What passes a cube passes
  /// its octants: those of a free one need no look.
  void intersect_octants(const CubeInView& cube, int edge, UpdateType type,
                         OctantUpdates& octants) const;

  /// The evidence for a block of this type. Voxels that `known` shows to be surely free may be
  /// left out where they are free. False if there is none.
  bool collect(const BlockIndex& index, UpdateType type, const VoxelBlock* known,
               BlockEvidence& evidence) const;

 private:
  struct Work;
  void descend(const CubeInView& cube, int edge, int offset, UpdateType type, Work& work) const;
  void look(const CubeInView& cube, Work& work) const;
  [[nodiscard]] VoxelCube voxels_of(const CubeInView& cube, int edge, int offset) const;

  const CubeView& view_;
  DepthRangeTiles tiles_;
  const DepthMeanPyramid& means_;
  const MeasurementModel& model_;
  const KernelParams& params_;
  std::uint64_t frame_number_;
};

}  // namespace swiftlet
