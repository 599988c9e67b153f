// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <cstring>

#include "swiftlet/integrate/projective/cell_kernels.hpp"

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/projective/free_cells.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "swiftlet/integrate/projective/cell_lanes_private.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

constexpr int kRowLanes = 4;  // lanes 0..3 are neighbours along x, 4..7 the next row along y
HWY_ALIGN constexpr float kLaneX[16] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
HWY_ALIGN constexpr float kLaneY[16] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

/// Observations that cells get from a frame whose every pixel is a ray through them to beyond: DW
/// times the area of their image. A patch dA of a face at q with normal n covers |n q| / q_z^3 dA
/// of the plane z = 1; over one face |n q| is constant, and 1 / q_z^3 averages to
/// 1 / z^3 (1 + 6 var(q_z) / z^2) around its middle.
///
/// By chords it is the mean of DW over the cell's volume, which is one.
HWY_INLINE FloatLanes observations(const KernelParams& params, const CellLanes& cells) {
  constexpr Floats f;
  if (params.has_chords) return hn::Set(f, 1.0F);
  const FloatLanes half = hn::Set(f, 0.5F * params.voxel_m);
  FloatLanes sum = hn::Zero(f);
  for (int i = 0; i < 3; ++i) {
    const float along = params.world_axis[i][2];
    // Depth over a face is uniform along its two edges: variance (a_j^2 + a_k^2) c^2 / 12.
    const float spread = 0.5F * (1.0F - along * along) * params.voxel_m * params.voxel_m;
    const FloatLanes distance = hn::Max(hn::Zero(f), hn::Sub(hn::Abs(cells.world[i]), half));
    const FloatLanes to_face = hn::Mul(hn::CopySign(half, cells.world[i]), hn::Set(f, along));
    const FloatLanes per_z = hn::Div(hn::Set(f, 1.0F), hn::Sub(cells.camera[2], to_face));
    const FloatLanes per_z2 = hn::Mul(per_z, per_z);
    const FloatLanes bend = hn::Add(hn::Set(f, 1.0F), hn::Mul(hn::Set(f, spread), per_z2));
    sum = hn::Add(sum, hn::Mul(hn::Mul(distance, hn::Mul(per_z, per_z2)), bend));
  }
  return hn::Mul(sum, hn::Mul(cells.camera[2], cells.camera[2]));
}

void free_cells(const KernelParams& params, const CellCube& cube, FixedSteps* evidence) {
  constexpr Floats f;
  constexpr Ints i;
  const auto rows = static_cast<int>(hn::Lanes(f)) / kRowLanes;
  const FloatLanes lane_x = hn::Load(f, kLaneX), lane_y = hn::Load(f, kLaneY);
  for (int z = 0; z < cube.edge; ++z) {
    for (int y = 0; y < cube.edge; y += rows) {
      for (int x = 0; x < cube.edge; x += kRowLanes) {
        const CellLanes cells = cells_at(
            params, cube, hn::Add(lane_x, hn::Set(f, static_cast<float>(x))),
            hn::Add(lane_y, hn::Set(f, static_cast<float>(y))), hn::Set(f, static_cast<float>(z)));
        const FloatLanes log_odds =
            hn::Mul(observations(params, cells), hn::Set(f, params.clear_log_odds));
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

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(free_cells);

void fill_free(const KernelParams& params, const CellCube& cube, FixedSteps* evidence) {
  HWY_DYNAMIC_DISPATCH(free_cells)(params, cube, evidence);
}

}  // namespace swiftlet
#endif
