// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the tile of readings at a sample says about a cell. Included once for every instruction set,
// so there is no #pragma once but Highway's toggle.
#if defined(SWIFTLET_TILE_EVIDENCE_PRIVATE) == defined(HWY_TARGET_TOGGLE)
#ifdef SWIFTLET_TILE_EVIDENCE_PRIVATE
#undef SWIFTLET_TILE_EVIDENCE_PRIVATE
#else
#define SWIFTLET_TILE_EVIDENCE_PRIVATE
#endif

#include "swiftlet/integrate/projective/cell_lanes_private.hpp"

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
inline constexpr float kWholeNumbers = 8388608.0F;
inline constexpr std::int32_t kWholeBits = 0x7fffff;

/// Rounded to the nearest, in the last 23 bits; a conversion that is right for all floats takes
/// three times as long. REQUIRES: 0 <= x < 2^22.
HWY_INLINE IntLanes whole_number(FloatLanes x) {
  return hn::BitCast(Ints(), hn::Add(x, hn::Set(Floats(), kWholeNumbers)));
}

/// With IsInside, all of the cells is known to lie inside the image.
template <bool IsInside>
HWY_INLINE Sample sample_at(const KernelParams& params, const DepthMeanTiles& tiles,
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
  FloatLanes u = place(0, params.fx, params.u_offset), v = place(1, params.fy, params.v_offset);
  if constexpr (!IsInside) {
    const auto is_in_u = hn::And(hn::Ge(u, zero), hn::Lt(u, hn::Set(f, params.width)));
    const auto is_in_v = hn::And(hn::Ge(v, zero), hn::Lt(v, hn::Set(f, params.height)));
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

/// What one sample says.
struct SampleEvidence {
  FloatLanes log_odds;  ///< * kAll
  FloatLanes ends;      ///< * kAll, ChordModel::Evidence; what does not hold cells leaves it alone

  HWY_INLINE SampleEvidence() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
};

HWY_INLINE FloatLanes share_of(IntLanes word) {
  const IntLanes share = hn::And(hn::ShiftRight<16>(word), hn::Set(Ints(), 0xff));
  return hn::ConvertTo(Floats(), share);
}

/// The readings of a tile, for each of several cells.
struct Readings {
  IntLanes code;      // of their depth
  FloatLanes per_z;   // 1 / that [1/m]
  FloatLanes narrow;  // sigma / deviation
  FloatLanes share;   // * kAll

  HWY_INLINE Readings() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
};

HWY_INLINE Readings readings_at(const DepthMeanTiles& tiles, IntLanes tile) {
  constexpr Floats f;
  constexpr Ints i;
  constexpr hn::RebindToUnsigned<Ints> n;
  const IntLanes word = hn::GatherIndex(i, tiles.words, tile);
  Readings r;
  r.code = hn::And(word, hn::Set(i, DepthMeanTiles::kCodes - 1));
  r.per_z = hn::BitCast(f, hn::ShiftLeft<DepthMeanTiles::kCodeShift>(
                               hn::Add(r.code, hn::Set(i, DepthMeanTiles::kFirstCode))));
  const IntLanes agreement = hn::BitCast(i, hn::ShiftRight<24>(hn::BitCast(n, word)));
  const FloatLanes root =
      hn::Mul(hn::ConvertTo(f, agreement), hn::Set(f, 1.0F / DepthMeanTiles::kNarrowest));
  r.narrow = hn::Mul(root, root);
  r.share = share_of(word);
  return r;
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

/// What the kernels need to know of a cell: the depth of its centre.
struct CentreOfFace {
  FloatLanes z;

  HWY_INLINE CentreOfFace() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
  HWY_INLINE CentreOfFace(const KernelParams&, const CellLanes& cells, std::size_t)
      : z(cells.camera[2]) {}
};

/// What the readings of a tile say of the cells by InverseSensorModel: nothing if their band ends
/// before their rays enter.
struct SliceEvidence {
  using OfFace = CentreOfFace;
  static constexpr bool kHolds = false;

  HWY_INLINE static SampleEvidence evaluate(const KernelParams& params, const DepthMeanTiles& tiles,
                                            const Sample& s, const OfFace& cell,
                                            const FaceSample&) {
    constexpr Floats f;
    constexpr Ints i;
    const Readings readings = readings_at(tiles, s.tile);
    const FloatLanes per_z = readings.per_z, narrow = readings.narrow;

    // Distances behind the readings' mean m in their deviations: (z - m) / sigma with sigma = a m^2
    // is (z / m - 1) / (a m).
    const FloatLanes one = hn::Set(f, 1.0F);
    const FloatLanes scale = hn::Mul(per_z, hn::Set(f, params.per_sigma));
    const FloatLanes centre = hn::Mul(scale, hn::Sub(hn::Mul(cell.z, per_z), one));
    const FloatLanes half = hn::Mul(hn::Mul(scale, per_z), hn::Set(f, 0.5F * params.voxel_m));
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
    const IntLanes row = hn::ShiftLeft<3>(hn::And(readings.code, hn::Set(i, 0xff00)));
    const IntLanes place = hn::Or(hn::Or(row, hn::ShiftLeft<8>(of_class)),
                                  hn::And(column, hn::Set(i, EvidenceTable::kColumns - 1)));
    const FloatLanes log_odds = hn::GatherIndex(f, params.model, place);

    const FloatLanes reach = hn::Set(f, EvidenceTable::kReachSigma);
    const FloatLanes inset = hn::Sub(entry, hn::Sub(centre, half));
    SampleEvidence result;
    result.log_odds =
        hn::Mul(hn::Mul(log_odds, readings.share), reaching(hn::Sub(reach, entry), inset, narrow));
    return result;
  }
};

/// What the readings of a tile say of cells that all of them pass.
struct PassedSlice {
  using OfFace = CentreOfFace;
  static constexpr bool kHolds = false;

  HWY_INLINE static SampleEvidence evaluate(const KernelParams& params, const DepthMeanTiles& tiles,
                                            const Sample& s, const OfFace&, const FaceSample&) {
    constexpr Floats f;
    const FloatLanes share = share_of(hn::GatherIndex(Ints(), tiles.words, s.tile));
    SampleEvidence result;
    result.log_odds = hn::Mul(share, hn::Set(f, params.free_log_odds));
    return result;
  }
};

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
