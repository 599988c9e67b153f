// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>

#include "swiftlet/integrate/cell_kernels.hpp"

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/sampled_cells.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "swiftlet/integrate/tile_evidence_private.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

/// Cells are asked in groups of so many, in as many vectors as that takes on this machine.
constexpr std::size_t kGroup = CellList::kSpare;
constexpr std::size_t kVectors = kGroup / hn::MaxLanes(Floats());
/// Where the first few samples of a face say the same [log-odds], for each cell of a group, the
/// others would, too.
constexpr std::size_t kFew = 4;
constexpr float kFlat = 0.015F;

/// One face of each of several cells, and what the samples on it say so far.
struct Face {
  FloatLanes middle[3], z_cell;
  FloatLanes sum, least, most;

  HWY_INLINE Face() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
  HWY_INLINE Face(const FrameInView& frame, const CellLanes& cells, std::size_t axis) {
    constexpr Floats f;
    const FloatLanes to_face = hn::CopySign(hn::Set(f, 0.5F * frame.voxel_m), cells.world[axis]);
    for (int i = 0; i < 3; ++i) {
      middle[i] = hn::Sub(cells.camera[i], hn::Mul(to_face, hn::Set(f, frame.world_axis[axis][i])));
    }
    z_cell = cells.camera[2];
    sum = hn::Zero(f);
    least = hn::Set(f, 1e9F);
    most = hn::Neg(least);
  }

  template <class What, bool IsInside>
  HWY_INLINE void add(const FrameInView& frame, const CellLook& look, const Float3& to) {
    const Sample s = sample_at<IsInside>(frame, look.tiles, middle, to);
    const FloatLanes rays = hn::Mul(s.per_z, hn::Mul(s.per_z, s.per_z));
    FloatLanes log_odds = What::log_odds(frame, look.tiles, s, z_cell);
    if constexpr (!IsInside) log_odds = hn::IfThenElseZero(s.is_inside, log_odds);
    sum = hn::Add(sum, hn::Mul(rays, log_odds));
    least = hn::Min(least, log_odds);
    most = hn::Max(most, log_odds);
  }

  [[nodiscard]] HWY_INLINE bool is_flat() const {
    constexpr Floats f;
    return hn::AllTrue(f, hn::Lt(hn::Sub(most, least), hn::Set(f, kFlat * ReadingTiles::kAll)));
  }
};

/// The sum over rays as an integral over the faces that the camera sees: each is crossed by
/// |n q| / q_z^3 rays per area, and a ray counts DW, z^2 times a constant that the area cancels.
/// Adds one face's part to the sums of a group of cells.
template <class What, bool IsInside>
HWY_INLINE void add_face(const FrameInView& frame, const CellLook& look, const CellLanes* cells,
                         std::size_t axis, FloatLanes* sums) {
  constexpr Floats f;
  Face faces[kVectors];
  for (std::size_t v = 0; v < kVectors; ++v) faces[v] = Face(frame, cells[v], axis);
  const std::span<const Float3> places = look.samples.on_face(axis);
  std::size_t count = std::min(places.size(), kFew);
  bool is_flat = true;
  for (Face& face : faces) {
    for (std::size_t k = 0; k < count; ++k) face.add<What, IsInside>(frame, look, places[k]);
    is_flat = is_flat && face.is_flat();
  }
  if (!is_flat) {
    for (Face& face : faces) {
      for (const Float3& to : places.subspan(count)) face.add<What, IsInside>(frame, look, to);
    }
    count = places.size();
  }
  const FloatLanes per_count = hn::Set(f, 1.0F / (ReadingTiles::kAll * static_cast<float>(count)));
  for (std::size_t v = 0; v < kVectors; ++v) {
    const FloatLanes half = hn::Set(f, 0.5F * frame.voxel_m);
    const FloatLanes distance = hn::Max(hn::Zero(f), hn::Sub(hn::Abs(cells[v].world[axis]), half));
    sums[v] = hn::Add(sums[v], hn::Mul(hn::Mul(distance, per_count), faces[v].sum));
  }
}

template <class What, bool IsInside>
HWY_INLINE void fill(const FrameInView& frame, const CellCube& block, const CellList& list,
                     const CellLook& look, FixedSteps* evidence) {
  constexpr Floats f;
  constexpr Ints i;
  const std::size_t lanes = hn::Lanes(f);
  for (std::size_t k = 0; k < list.count; k += kGroup) {
    CellLanes cells[kVectors];
    FloatLanes sums[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) {
      const std::size_t at = k + v * lanes;
      cells[v] = cells_at(frame, block, hn::LoadU(f, &list.x[at]), hn::LoadU(f, &list.y[at]),
                          hn::LoadU(f, &list.z[at]));
      sums[v] = hn::Zero(f);
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      add_face<What, IsInside>(frame, look, cells, axis, sums);
    HWY_ALIGN FixedSteps steps[kGroup];
    for (std::size_t v = 0; v < kVectors; ++v) {
      const FloatLanes z = hn::Max(hn::Zero(f), cells[v].camera[2]);
      hn::Store(fixed_steps(frame, hn::Mul(sums[v], hn::Mul(z, z))), i, steps + v * lanes);
    }
    const std::size_t here = std::min(kGroup, list.count - k);
    for (std::size_t lane = 0; lane < here; ++lane) evidence[list.offset[k + lane]] = steps[lane];
  }
}

void passed_cells(const FrameInView& frame, const CellCube& block, const CellList& cells,
                  const CellLook& look, FixedSteps* evidence) {
  if (look.is_inside_image) {
    fill<PassedBy, true>(frame, block, cells, look, evidence);
  } else {
    fill<PassedBy, false>(frame, block, cells, look, evidence);
  }
}

void sampled_cells(const FrameInView& frame, const CellCube& block, const CellList& cells,
                   const CellLook& look, FixedSteps* evidence) {
  if (look.is_inside_image) {
    fill<ModelOf, true>(frame, block, cells, look, evidence);
  } else {
    fill<ModelOf, false>(frame, block, cells, look, evidence);
  }
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(passed_cells);
HWY_EXPORT(sampled_cells);

void fill_passed(const FrameInView& frame, const CellCube& block, const CellList& cells,
                 const CellLook& look, FixedSteps* evidence) {
  HWY_DYNAMIC_DISPATCH(passed_cells)(frame, block, cells, look, evidence);
}

void fill_sampled(const FrameInView& frame, const CellCube& block, const CellList& cells,
                  const CellLook& look, FixedSteps* evidence) {
  HWY_DYNAMIC_DISPATCH(sampled_cells)(frame, block, cells, look, evidence);
}

}  // namespace swiftlet
#endif
