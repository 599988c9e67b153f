// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>

#include "swiftlet/integrate/cell_kernels.hpp"

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/sampled_cells.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "swiftlet/integrate/cell_lanes_private.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

/// One sample for each of several cells: where their rays enter them, and the tile they end in.
struct Sample {
  FloatLanes z, per_z;
  hn::Mask<Floats> is_inside;  // the image
  IntLanes tile;               // 0 outside

  HWY_INLINE Sample() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
};

HWY_INLINE Sample sample_at(const FrameInView& frame, const ReadingTiles& tiles,
                            const FloatLanes* face, const Float3& to) {
  constexpr Floats f;
  constexpr Ints i;
  const FloatLanes zero = hn::Zero(f);
  Sample s;
  s.z = hn::Add(face[2], hn::Set(f, to[2]));
  s.per_z = hn::Div(hn::Set(f, 1.0F), s.z);
  const auto place = [&](int axis, float focal, float offset) {
    const FloatLanes slope = hn::Mul(hn::Add(face[axis], hn::Set(f, to[axis])), s.per_z);
    return hn::Add(hn::Mul(slope, hn::Set(f, focal)), hn::Set(f, offset));
  };
  const FloatLanes u = place(0, frame.fx, frame.u_offset), v = place(1, frame.fy, frame.v_offset);
  const auto is_in_u = hn::And(hn::Ge(u, zero), hn::Lt(u, hn::Set(f, frame.width)));
  const auto is_in_v = hn::And(hn::Ge(v, zero), hn::Lt(v, hn::Set(f, frame.height)));
  s.is_inside = hn::And(hn::Gt(s.z, zero), hn::And(is_in_u, is_in_v));
  const IntLanes column = hn::ConvertTo(i, hn::IfThenElseZero(s.is_inside, u));
  const IntLanes row = hn::ConvertTo(i, hn::IfThenElseZero(s.is_inside, v));
  s.tile = hn::Add(hn::Mul(hn::ShiftRightSame(row, tiles.shift), hn::Set(i, tiles.stride)),
                   hn::ShiftRightSame(column, tiles.shift));
  return s;
}

HWY_INLINE IntLanes column_of(FloatLanes d, FloatLanes columns_per_m) {
  constexpr Floats f;
  constexpr Ints i;
  const FloatLanes place =
      hn::Add(hn::Mul(d, columns_per_m), hn::Set(f, EvidenceTable::kZero + 0.5F));
  constexpr auto kLast = static_cast<float>(EvidenceTable::kColumns - 1);
  return hn::ConvertTo(i, hn::Min(hn::Max(place, hn::Zero(f)), hn::Set(f, kLast)));
}

HWY_INLINE FloatLanes share_of(IntLanes word) {
  const IntLanes share = hn::And(hn::ShiftRight<16>(word), hn::Set(Ints(), 0xff));
  return hn::ConvertTo(Floats(), share);
}

/// What is left of a tile's evidence when the readings are left out whose band ends before their
/// rays enter the cell: all or nothing, unless that place lies within their scatter. Those left out
/// are the ones that say the least, so all of it is left until their mean is among them.
HWY_INLINE FloatLanes reaching(FloatLanes beyond, FloatLanes sigma, FloatLanes per_deviation) {
  constexpr Floats f;
  const FloatLanes zero = hn::Zero(f), one = hn::Set(f, 1.0F);
  const FloatLanes whole = hn::IfThenElseZero(hn::Ge(beyond, zero), one);
  const auto is_plain = hn::Gt(hn::Mul(hn::Abs(beyond), per_deviation), hn::Set(f, 2.5F));
  if (hn::AllTrue(f, is_plain)) return whole;
  const FloatLanes deviation = hn::Div(one, per_deviation);
  const FloatLanes scatter2 = hn::Sub(hn::Mul(deviation, deviation), hn::Mul(sigma, sigma));
  const FloatLanes scatter = hn::Sqrt(hn::Max(scatter2, hn::Set(f, 1e-8F)));
  // The normal distribution's integral is about a ramp.
  const FloatLanes ramp =
      hn::Add(hn::Set(f, 0.7F), hn::Div(hn::Mul(beyond, hn::Set(f, 0.4F)), scatter));
  return hn::Min(hn::Max(ramp, zero), one);
}

/// Log-odds * kAll that the readings of a tile give the cells: nothing if their band ends before
/// their rays enter.
struct ModelOf {
  HWY_INLINE static FloatLanes log_odds(const FrameInView& frame, const ReadingTiles& tiles,
                                        const Sample& s, FloatLanes z_cell) {
    constexpr Floats f;
    constexpr Ints i;
    constexpr hn::RebindToUnsigned<Ints> n;
    const IntLanes word = hn::GatherIndex(i, tiles.words, s.tile);
    const IntLanes raw = hn::And(word, hn::Set(i, 0xffff));
    const FloatLanes share = share_of(word);
    const IntLanes agreement = hn::BitCast(i, hn::ShiftRight<24>(hn::BitCast(n, word)));
    const FloatLanes root =
        hn::Mul(hn::ConvertTo(f, agreement), hn::Set(f, 1.0F / ReadingTiles::kNarrowest));
    const FloatLanes narrow = hn::Mul(root, root);  // sigma / deviation

    const FloatLanes z = hn::Mul(hn::ConvertTo(f, raw), hn::Set(f, frame.unit_m));
    const FloatLanes sigma = hn::Mul(hn::Mul(z, z), hn::Set(f, frame.sigma_per_z2));
    const FloatLanes beyond =
        hn::Sub(hn::Add(z, hn::Mul(sigma, hn::Set(f, EvidenceTable::kReachSigma))), s.z);
    const FloatLanes per_deviation = hn::Div(narrow, hn::Max(sigma, hn::Set(f, 1e-9F)));
    constexpr auto kMostClass = static_cast<float>(EvidenceTable::kClasses - 1);
    const IntLanes of_class =
        hn::ConvertTo(i, hn::Add(hn::Mul(narrow, hn::Set(f, kMostClass)), hn::Set(f, 0.5F)));
    static_assert(EvidenceTable::kClasses == 8);
    const IntLanes row = hn::ShiftLeft<3>(hn::ShiftRightSame(raw, frame.row_shift));
    const IntLanes first = hn::Mul(hn::Add(row, of_class), hn::Set(i, EvidenceTable::kColumns));

    const FloatLanes half = hn::Set(f, 0.5F * frame.voxel_m);
    const FloatLanes offset = hn::Sub(z_cell, z);
    const FloatLanes columns = hn::Mul(per_deviation, hn::Set(f, EvidenceTable::kPerDeviation));
    const IntLanes at_rise = hn::Add(first, column_of(hn::Add(offset, half), columns));
    const IntLanes at_fall = hn::Add(first, column_of(hn::Sub(offset, half), columns));
    const FloatLanes log_odds =
        hn::Add(hn::GatherIndex(f, frame.rise, at_rise), hn::GatherIndex(f, frame.fall, at_fall));
    return hn::Mul(hn::Mul(log_odds, share), reaching(beyond, sigma, per_deviation));
  }
};

/// Log-odds * kAll of cells that all readings pass.
struct PassedBy {
  HWY_INLINE static FloatLanes log_odds(const FrameInView& frame, const ReadingTiles& tiles,
                                        const Sample& s, FloatLanes) {
    constexpr Floats f;
    const FloatLanes share = share_of(hn::GatherIndex(Ints(), tiles.words, s.tile));
    return hn::IfThenElseZero(s.is_inside, hn::Mul(share, hn::Set(f, frame.free_log_odds)));
  }
};

/// The sum over rays as an integral over the faces that the camera sees: each is crossed by
/// |n q| / q_z^3 rays per area, and a ray counts DW, z^2 times a constant that the area cancels.
template <class What>
HWY_INLINE FloatLanes integral(const FrameInView& frame, const FaceSamples& samples,
                               const ReadingTiles& tiles, const CellLanes& cells) {
  constexpr Floats f;
  const FloatLanes half = hn::Set(f, 0.5F * frame.voxel_m);
  FloatLanes sum = hn::Zero(f);
  for (std::size_t i = 0; i < 3; ++i) {
    const FloatLanes distance = hn::Max(hn::Zero(f), hn::Sub(hn::Abs(cells.world[i]), half));
    const FloatLanes to_face = hn::CopySign(half, cells.world[i]);
    FloatLanes face[3];
    for (int axis = 0; axis < 3; ++axis) {
      face[axis] =
          hn::Sub(cells.camera[axis], hn::Mul(to_face, hn::Set(f, frame.world_axis[i][axis])));
    }
    FloatLanes on_face = hn::Zero(f);
    for (const Float3& to : samples.on_face(i)) {
      const Sample s = sample_at(frame, tiles, face, to);
      const FloatLanes rays = hn::Mul(s.per_z, hn::Mul(s.per_z, s.per_z));
      const FloatLanes log_odds = What::log_odds(frame, tiles, s, cells.camera[2]);
      on_face = hn::Add(on_face, hn::IfThenElseZero(s.is_inside, hn::Mul(rays, log_odds)));
    }
    const float per_count =
        1.0F / (ReadingTiles::kAll * static_cast<float>(samples.on_face(i).size()));
    sum = hn::Add(sum, hn::Mul(hn::Mul(distance, hn::Set(f, per_count)), on_face));
  }
  const FloatLanes z = hn::Max(hn::Zero(f), cells.camera[2]);
  return hn::Mul(sum, hn::Mul(z, z));
}

template <class What>
HWY_INLINE void fill(const FrameInView& frame, const CellCube& block, const CellList& list,
                     const FaceSamples& samples, const ReadingTiles& tiles, FixedSteps* evidence) {
  constexpr Floats f;
  constexpr Ints i;
  const std::size_t lanes = hn::Lanes(f);
  for (std::size_t k = 0; k < list.count; k += lanes) {
    const CellLanes cells = cells_at(frame, block, hn::LoadU(f, &list.x[k]),
                                     hn::LoadU(f, &list.y[k]), hn::LoadU(f, &list.z[k]));
    HWY_ALIGN FixedSteps steps[16];
    hn::Store(fixed_steps(frame, integral<What>(frame, samples, tiles, cells)), i, steps);
    const std::size_t here = std::min(lanes, list.count - k);
    for (std::size_t lane = 0; lane < here; ++lane) evidence[list.offset[k + lane]] = steps[lane];
  }
}

void passed_cells(const FrameInView& frame, const CellCube& block, const CellList& cells,
                  const FaceSamples& samples, const ReadingTiles& tiles, FixedSteps* evidence) {
  fill<PassedBy>(frame, block, cells, samples, tiles, evidence);
}

void sampled_cells(const FrameInView& frame, const CellCube& block, const CellList& cells,
                   const FaceSamples& samples, const ReadingTiles& tiles, FixedSteps* evidence) {
  fill<ModelOf>(frame, block, cells, samples, tiles, evidence);
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(passed_cells);
HWY_EXPORT(sampled_cells);

void fill_passed(const FrameInView& frame, const CellCube& block, const CellList& cells,
                 const FaceSamples& samples, const ReadingTiles& tiles, FixedSteps* evidence) {
  HWY_DYNAMIC_DISPATCH(passed_cells)(frame, block, cells, samples, tiles, evidence);
}

void fill_sampled(const FrameInView& frame, const CellCube& block, const CellList& cells,
                  const FaceSamples& samples, const ReadingTiles& tiles, FixedSteps* evidence) {
  HWY_DYNAMIC_DISPATCH(sampled_cells)(frame, block, cells, samples, tiles, evidence);
}

}  // namespace swiftlet
#endif
