// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Voxels that every ray passes. Included once for every instruction set, so there is no #pragma
// once but Highway's toggle.
#if defined(SWIFTLET_FREE_VOXELS_PRIVATE) == defined(HWY_TARGET_TOGGLE)
#ifdef SWIFTLET_FREE_VOXELS_PRIVATE
#undef SWIFTLET_FREE_VOXELS_PRIVATE
#else
#define SWIFTLET_FREE_VOXELS_PRIVATE
#endif

#include <cstring>

#include "swiftlet/integrate/projective/voxel_lanes_private.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

constexpr int kRowLanes = 4;  // lanes 0..3 are neighbours along x, 4..7 the next row along y
HWY_ALIGN constexpr float kLaneX[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
HWY_ALIGN constexpr float kLaneY[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

/// Writes the evidence of all voxels of a cube. `Model::observations(params, voxels)` is how many
/// whole observations a frame gives to voxels whose every pixel is a ray through them to beyond.
template <class Model>
HWY_INLINE void fill_free_voxels(const KernelParams& params, const VoxelCube& cube,
                                 FixedSteps* evidence) {
  constexpr Floats f;
  constexpr Ints i;
  const auto rows = static_cast<int>(hn::Lanes(f)) / kRowLanes;
  const FloatLanes lane_x = hn::Load(f, kLaneX), lane_y = hn::Load(f, kLaneY);
  for (int z = 0; z < cube.edge; ++z) {
    for (int y = 0; y < cube.edge; y += rows) {
      for (int x = 0; x < cube.edge; x += kRowLanes) {
        const VoxelLanes voxels = voxels_at(
            params, cube, hn::Add(lane_x, hn::Set(f, static_cast<float>(x))),
            hn::Add(lane_y, hn::Set(f, static_cast<float>(y))), hn::Set(f, static_cast<float>(z)));
        const FloatLanes log_odds =
            hn::Mul(Model::observations(params, voxels), hn::Set(f, params.model.clear_log_odds));
        HWY_ALIGN FixedSteps lanes[16];
        hn::Store(fixed_steps(params, log_odds), i, lanes);
        FixedSteps* first = evidence + (cube.offset + kBlockEdge * (y + kBlockEdge * z) + x);
        for (std::ptrdiff_t row = 0; row < rows; ++row)
          std::memcpy(first + kBlockEdge * row, lanes + kRowLanes * row,
                      kRowLanes * sizeof(FixedSteps));
      }
    }
  }
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
