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

/// 2^23: floats from here on are whole numbers, and their last bits are the number.
constexpr float kWholeNumbers = 8388608.0F;
constexpr std::int32_t kWholeBits = 0x7fffff;

/// Rounded to the nearest, in the last 23 bits; a conversion that is right for all floats takes
/// three times as long. REQUIRES: 0 <= x < 2^22.
HWY_INLINE IntLanes whole_number(FloatLanes x) {
  return hn::BitCast(Ints(), hn::Add(x, hn::Set(Floats(), kWholeNumbers)));
}

/// With kIsInside, all of the cells is known to lie inside the image.
template <bool kIsInside>
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
  FloatLanes u = place(0, frame.fx, frame.u_offset), v = place(1, frame.fy, frame.v_offset);
  if constexpr (!kIsInside) {
    const auto is_in_u = hn::And(hn::Ge(u, zero), hn::Lt(u, hn::Set(f, frame.width)));
    const auto is_in_v = hn::And(hn::Ge(v, zero), hn::Lt(v, hn::Set(f, frame.height)));
    s.is_inside = hn::And(hn::Gt(s.z, zero), hn::And(is_in_u, is_in_v));
    u = hn::IfThenElseZero(s.is_inside, u);
    v = hn::IfThenElseZero(s.is_inside, v);
  }
  // Rounds down but for whole numbers, of which every second is rounded to the one below.
  const FloatLanes per_tile = hn::Set(f, 1.0F / static_cast<float>(1 << tiles.shift));
  const FloatLanes half = hn::Set(f, 0.5F), whole = hn::Set(f, 1.5F * kWholeNumbers);
  const auto tile_of = [&](FloatLanes pixel) {
    return hn::Sub(hn::Add(hn::Sub(hn::Mul(pixel, per_tile), half), whole), whole);
  };
  const FloatLanes row = hn::Mul(tile_of(v), hn::Set(f, static_cast<float>(tiles.stride)));
  s.tile = hn::And(whole_number(hn::Add(row, tile_of(u))), hn::Set(i, kWholeBits));
  return s;
}

HWY_INLINE FloatLanes share_of(IntLanes word) {
  const IntLanes share = hn::And(hn::ShiftRight<16>(word), hn::Set(Ints(), 0xff));
  return hn::ConvertTo(Floats(), share);
}

HWY_INLINE FloatLanes within_reach(FloatLanes d) {
  constexpr Floats f;
  const FloatLanes reach = hn::Set(f, EvidenceTable::kReach);
  return hn::Min(hn::Max(d, hn::Neg(reach)), reach);
}

/// What is left of a tile's evidence when the readings are left out whose band ends before their
/// rays enter the cell, which is `inset` behind the near side of its slice. Up to a deviation of
/// that they say next to nothing anyway. Else it is all or nothing, unless that place lies within
/// their scatter; those left out are the ones that say the least, so all is left until their mean
/// is among them. Lengths in deviations of a reading.
HWY_INLINE FloatLanes reaching(FloatLanes beyond, FloatLanes inset, FloatLanes narrow) {
  constexpr Floats f;
  const FloatLanes one = hn::Set(f, 1.0F);
  const auto is_whole = hn::Le(inset, one);
  if (hn::AllTrue(f, is_whole)) return one;
  const FloatLanes zero = hn::Zero(f);
  const FloatLanes whole = hn::IfThenElseZero(hn::Or(is_whole, hn::Ge(beyond, zero)), one);
  const auto is_plain = hn::Gt(hn::Mul(hn::Abs(beyond), narrow), hn::Set(f, 2.5F));
  if (hn::AllTrue(f, hn::Or(is_whole, is_plain))) return whole;
  // The normal distribution's integral is about a ramp.
  const FloatLanes scatter2 = hn::Max(hn::Sub(one, hn::Mul(narrow, narrow)), hn::Set(f, 1e-4F));
  const FloatLanes beyond_narrow = hn::Mul(hn::Mul(beyond, narrow), hn::Set(f, 0.4F));
  const FloatLanes ramp = hn::Add(hn::Set(f, 0.7F), hn::Div(beyond_narrow, hn::Sqrt(scatter2)));
  return hn::IfThenElse(is_whole, one, hn::Min(hn::Max(ramp, zero), one));
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
    const IntLanes code = hn::And(word, hn::Set(i, ReadingTiles::kCodes - 1));
    const FloatLanes per_z = hn::BitCast(f, hn::ShiftLeft<ReadingTiles::kCodeShift>(hn::Add(
                                                code, hn::Set(i, ReadingTiles::kFirstCode))));
    const IntLanes agreement = hn::BitCast(i, hn::ShiftRight<24>(hn::BitCast(n, word)));
    const FloatLanes root =
        hn::Mul(hn::ConvertTo(f, agreement), hn::Set(f, 1.0F / ReadingTiles::kNarrowest));
    const FloatLanes narrow = hn::Mul(root, root);  // sigma / deviation

    // Distances behind the readings' mean m in their deviations: (z - m) / sigma with sigma = a m^2
    // is (z / m - 1) / (a m).
    const FloatLanes one = hn::Set(f, 1.0F);
    const FloatLanes scale = hn::Mul(per_z, hn::Set(f, frame.per_sigma));
    const FloatLanes centre = hn::Mul(scale, hn::Sub(hn::Mul(z_cell, per_z), one));
    const FloatLanes half = hn::Mul(hn::Mul(scale, per_z), hn::Set(f, 0.5F * frame.voxel_m));
    const FloatLanes entry = hn::Mul(scale, hn::Sub(hn::Mul(s.z, per_z), one));
    const FloatLanes far_side = within_reach(hn::Mul(hn::Add(centre, half), narrow));
    const FloatLanes near_side = within_reach(hn::Mul(hn::Sub(centre, half), narrow));
    const FloatLanes middle = hn::Set(f, EvidenceTable::kMiddle);
    const FloatLanes per_deviation = hn::Set(f, EvidenceTable::kPerDeviation);
    const IntLanes column =
        whole_number(hn::Add(hn::Mul(hn::Add(far_side, near_side), per_deviation), middle));
    constexpr auto kMostClass = static_cast<float>(EvidenceTable::kClasses - 1);
    const IntLanes of_class = whole_number(hn::Mul(narrow, hn::Set(f, kMostClass)));
    // Shifts and masks drop what marks whole_number()s.
    static_assert(EvidenceTable::kClasses == 8 && EvidenceTable::kColumns == 256 &&
                  EvidenceTable::kRowShift == 8);
    const IntLanes row = hn::ShiftLeft<3>(hn::And(code, hn::Set(i, 0xff00)));
    const IntLanes place = hn::Or(hn::Or(row, hn::ShiftLeft<8>(of_class)),
                                  hn::And(column, hn::Set(i, EvidenceTable::kColumns - 1)));
    const FloatLanes log_odds = hn::GatherIndex(f, frame.model, place);

    const FloatLanes reach = hn::Set(f, EvidenceTable::kReachSigma);
    const FloatLanes inset = hn::Sub(entry, hn::Sub(centre, half));
    return hn::Mul(hn::Mul(log_odds, share_of(word)),
                   reaching(hn::Sub(reach, entry), inset, narrow));
  }
};

/// Log-odds * kAll of cells that all readings pass.
struct PassedBy {
  HWY_INLINE static FloatLanes log_odds(const FrameInView& frame, const ReadingTiles& tiles,
                                        const Sample& s, FloatLanes) {
    constexpr Floats f;
    const FloatLanes share = share_of(hn::GatherIndex(Ints(), tiles.words, s.tile));
    return hn::Mul(share, hn::Set(f, frame.free_log_odds));
  }
};

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

  template <class What, bool kIsInside>
  HWY_INLINE void add(const FrameInView& frame, const CellLook& look, const Float3& to) {
    const Sample s = sample_at<kIsInside>(frame, look.tiles, middle, to);
    const FloatLanes rays = hn::Mul(s.per_z, hn::Mul(s.per_z, s.per_z));
    FloatLanes log_odds = What::log_odds(frame, look.tiles, s, z_cell);
    if constexpr (!kIsInside) log_odds = hn::IfThenElseZero(s.is_inside, log_odds);
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
template <class What, bool kIsInside>
HWY_INLINE void add_face(const FrameInView& frame, const CellLook& look, const CellLanes* cells,
                         std::size_t axis, FloatLanes* sums) {
  constexpr Floats f;
  Face faces[kVectors];
  for (std::size_t v = 0; v < kVectors; ++v) faces[v] = Face(frame, cells[v], axis);
  const std::span<const Float3> places = look.samples.on_face(axis);
  std::size_t count = std::min(places.size(), kFew);
  bool is_flat = true;
  for (Face& face : faces) {
    for (std::size_t k = 0; k < count; ++k) face.add<What, kIsInside>(frame, look, places[k]);
    is_flat = is_flat && face.is_flat();
  }
  if (!is_flat) {
    for (Face& face : faces) {
      for (const Float3& to : places.subspan(count)) face.add<What, kIsInside>(frame, look, to);
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

template <class What, bool kIsInside>
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
      add_face<What, kIsInside>(frame, look, cells, axis, sums);
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
