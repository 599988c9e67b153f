// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the tile of readings at a sample says about a voxel. Included once for every instruction
// set, so there is no #pragma once but Highway's toggle.
#if defined(SWIFTLET_TILE_EVIDENCE_PRIVATE) == defined(HWY_TARGET_TOGGLE)
#ifdef SWIFTLET_TILE_EVIDENCE_PRIVATE
#undef SWIFTLET_TILE_EVIDENCE_PRIVATE
#else
#define SWIFTLET_TILE_EVIDENCE_PRIVATE
#endif

#include "swiftlet/integrate/projective/voxel_lanes_private.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

/// One sample for each of several voxels: where their rays enter them, and the tile they end in.
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

/// With IsInside, all of the voxels is known to lie inside the image.
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
  FloatLanes ends;      ///< * kAll, of rays that end less those that pass; of models that ask

  HWY_INLINE SampleEvidence() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
};

HWY_INLINE FloatLanes share_of(IntLanes word) {
  const IntLanes share = hn::And(hn::ShiftRight<16>(word), hn::Set(Ints(), 0xff));
  return hn::ConvertTo(Floats(), share);
}

/// The readings of a tile, for each of several voxels.
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

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
