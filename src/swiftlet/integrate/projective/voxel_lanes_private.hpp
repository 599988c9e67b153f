// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the kernels of voxels share. Included once for every instruction set, so there is no #pragma
// once but Highway's toggle.
#if defined(SWIFTLET_VOXEL_LANES_PRIVATE) == defined(HWY_TARGET_TOGGLE)
#ifdef SWIFTLET_VOXEL_LANES_PRIVATE
#undef SWIFTLET_VOXEL_LANES_PRIVATE
#else
#define SWIFTLET_VOXEL_LANES_PRIVATE
#endif

#include "swiftlet/integrate/image/float_lanes_private.hpp"
#include "swiftlet/integrate/projective/kernel_params.hpp"
#include "swiftlet/integrate/projective/voxel_list.hpp"
#include "swiftlet/integrate/step_rounding.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

/// Centres of voxels relative to the camera [m].
struct VoxelLanes {
  FloatLanes world[3], camera[3];

  HWY_INLINE VoxelLanes() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
};

/// Voxels so many voxels along x, y, z from the first of a cube.
HWY_INLINE VoxelLanes voxels_at(const KernelParams& params, const VoxelCube& cube, FloatLanes x,
                                FloatLanes y, FloatLanes z) {
  constexpr Floats f;
  const FloatLanes voxel = hn::Set(f, params.voxel_m);
  const FloatLanes step[3] = {hn::Mul(x, voxel), hn::Mul(y, voxel), hn::Mul(z, voxel)};
  VoxelLanes voxels;
  for (int i = 0; i < 3; ++i) {
    voxels.world[i] = hn::Add(hn::Set(f, cube.p_world[i]), step[i]);
    const FloatLanes along_x = hn::Mul(step[0], hn::Set(f, params.world_axis[0][i]));
    const FloatLanes along_y = hn::Mul(step[1], hn::Set(f, params.world_axis[1][i]));
    const FloatLanes along_z = hn::Mul(step[2], hn::Set(f, params.world_axis[2][i]));
    voxels.camera[i] =
        hn::Add(hn::Add(hn::Set(f, cube.p_camera[i]), along_x), hn::Add(along_y, along_z));
  }
  return voxels;
}

/// Log-odds as evidence, within what saturates a voxel; kNotFree is not set.
HWY_INLINE IntLanes fixed_steps(const KernelParams& params, FloatLanes log_odds) {
  constexpr Floats f;
  constexpr Ints i;
  const FloatLanes steps = hn::Mul(log_odds, hn::Set(f, params.steps_per_log_odds));
  const FloatLanes most = hn::Set(f, static_cast<float>(kMostSteps));
  const IntLanes whole = hn::ConvertTo(i, hn::Min(hn::Max(steps, hn::Neg(most)), most));
  return hn::And(whole, hn::Set(i, ~kNotFree));
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
