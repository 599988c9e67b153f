// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// ChordModel in vectors. Included once for every instruction set, so there is no #pragma once but
// Highway's toggle.
#if defined(SWIFTLET_CHORD_EVIDENCE_PRIVATE) == defined(HWY_TARGET_TOGGLE)
#ifdef SWIFTLET_CHORD_EVIDENCE_PRIVATE
#undef SWIFTLET_CHORD_EVIDENCE_PRIVATE
#else
#define SWIFTLET_CHORD_EVIDENCE_PRIVATE
#endif

#include "swiftlet/integrate/projective/tile_evidence_private.hpp"
#include "swiftlet/sensor/chord_model.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

/// Where rays that enter cells by one face leave them. A ray passes the plane at distance d along
/// an axis at e / d of the depth at which it passes d, so the plane that it meets first is the one
/// with the largest share e / d, where e is the place of its entry.
struct ChordsOfFace {
  FloatLanes opposite_share;              // z_in / z of the plane opposite to the face
  FloatLanes world_j, world_k;            // of the middle of the face [m]
  FloatLanes per_far_j[2], per_far_k[2];  // 1 / the places of the other planes: lower, upper

  HWY_INLINE ChordsOfFace() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
  HWY_INLINE ChordsOfFace(const KernelParams& params, const CellLanes& cells, std::size_t axis)
      : world_j(cells.world[(axis + 1) % 3]), world_k(cells.world[(axis + 2) % 3]) {
    constexpr Floats f;
    const FloatLanes half = hn::Set(f, 0.5F * params.voxel_m), one = hn::Set(f, 1.0F);
    const FloatLanes across = hn::Abs(cells.world[axis]);
    opposite_share = hn::Div(hn::Sub(across, half), hn::Add(across, half));
    // A plane that rays meet lies ahead; one that lies behind is never asked for.
    const FloatLanes least = hn::Set(f, 1e-6F);
    const auto lower = [&](FloatLanes w) {
      return hn::Div(one, hn::Min(hn::Sub(w, half), hn::Neg(least)));
    };
    const auto upper = [&](FloatLanes w) { return hn::Div(one, hn::Max(hn::Add(w, half), least)); };
    per_far_j[0] = lower(world_j);
    per_far_j[1] = upper(world_j);
    per_far_k[0] = lower(world_k);
    per_far_k[1] = upper(world_k);
  }

  /// Depth [m] at which the ray of a sample leaves its cell.
  [[nodiscard]] HWY_INLINE FloatLanes z_out(FloatLanes z_in, const FaceSample& place) const {
    constexpr Floats f;
    const auto share = [](FloatLanes e, const FloatLanes* per_far) {
      return hn::Mul(e, hn::IfThenElse(hn::Lt(e, hn::Zero(Floats())), per_far[0], per_far[1]));
    };
    const FloatLanes e_j = hn::Add(world_j, hn::Set(f, place.along_j));
    const FloatLanes e_k = hn::Add(world_k, hn::Set(f, place.along_k));
    const FloatLanes most =
        hn::Max(opposite_share, hn::Max(share(e_j, per_far_j), share(e_k, per_far_k)));
    // Of a cell that the camera stands in nearly all is left; the last bound holds against
    // rounding.
    constexpr float kLeastShare = 0.01F;
    return hn::Div(z_in, hn::Min(hn::Max(most, hn::Set(f, kLeastShare)), hn::Set(f, 1.0F)));
  }
};

/// The readings of a tile, and the chords of the rays that end in it.
struct ReadingsAndChords {
  Readings readings;
  FloatLanes z_out;      // where the rays leave their cells [m]
  FloatLanes length;     // of the chords [cells]
  FloatLanes per_sigma;  // 1 / the deviation of the readings, in units of their depth

  HWY_INLINE ReadingsAndChords(const KernelParams& params, const DepthMeanTiles& tiles,
                               const Sample& s, const ChordsOfFace& cell, const FaceSample& place)
      : readings(readings_at(tiles, s.tile)), z_out(cell.z_out(s.z, place)) {
    constexpr Floats f;
    length = hn::Mul(hn::Sub(z_out, s.z), hn::Set(f, 1.0F / params.voxel_m));
    per_sigma = hn::Mul(hn::Mul(readings.per_z, hn::Set(f, params.per_sigma)), readings.narrow);
  }

  /// How far x [m] lies behind the readings, in units of their depth: with sigma = a z^2,
  /// (x - z) / sigma is (x / z - 1) / (a z), this times per_sigma.
  [[nodiscard]] HWY_INLINE FloatLanes behind(FloatLanes x) const {
    return hn::Sub(hn::Mul(x, readings.per_z), hn::Set(Floats(), 1.0F));
  }

  /// The least that the readings say of the cells.
  [[nodiscard]] HWY_INLINE FloatLanes least_log_odds(const KernelParams& params) const {
    constexpr Floats f;
    static_assert(ChordModel::kClearSigma <= EvidenceTable::kInFrontSigma);
    const FloatLanes sigmas =
        hn::Mul(behind(hn::Add(z_out, hn::Set(f, params.clear_m))), per_sigma);
    const auto is_clear = hn::Lt(sigmas, hn::Set(f, -ChordModel::kClearSigma));
    return hn::IfThenElse(is_clear, hn::Set(f, params.clear_log_odds),
                          hn::Set(f, params.free_log_odds));
  }
};

/// What the readings of a tile say of the cells by ChordModel.
struct ChordEvidence {
  using OfFace = ChordsOfFace;
  static constexpr bool kHolds = true;

  HWY_INLINE static SampleEvidence evaluate(const KernelParams& params, const DepthMeanTiles& tiles,
                                            const Sample& s, const OfFace& cell,
                                            const FaceSample& place) {
    constexpr Floats f;
    const ReadingsAndChords r(params, tiles, s, cell, place);
    const FloatLanes one = hn::Set(f, 1.0F), zero = hn::Zero(f);
    const FloatLanes gain = hn::Mul(hn::Mul(hn::Mul(r.per_sigma, r.per_sigma), r.readings.per_z),
                                    hn::Set(f, ChordModel::kIndependence * params.voxel_m));
    const FloatLanes middle = hn::Mul(hn::Add(s.z, r.z_out), hn::Set(f, 0.5F));
    const FloatLanes ratio =
        hn::Min(hn::Max(hn::Mul(gain, r.behind(middle)), r.least_log_odds(params)),
                hn::Set(f, ChordModel::kMostLogOdds));

    const FloatLanes hiding = hn::Set(f, ChordModel::kHidingCells * params.voxel_m);
    const FloatLanes before = hn::Mul(r.behind(hn::Sub(s.z, hiding)), r.per_sigma);
    const FloatLanes left =
        hn::Min(hn::Max(hn::Sub(hn::Set(f, ChordModel::kFadeSigma), before), zero), one);
    const auto is_reached = hn::Gt(left, zero);
    const FloatLanes fading = hn::IfThenElse(hn::Gt(ratio, zero), left, one);
    const FloatLanes share = hn::IfThenElseZero(is_reached, r.readings.share);
    SampleEvidence result;
    result.log_odds = hn::Mul(hn::Mul(ratio, fading), hn::Mul(r.length, share));

    const FloatLanes end = hn::Set(f, ChordModel::kEndCells * params.voxel_m);
    const auto passes = hn::Lt(r.behind(hn::Add(r.z_out, end)), zero);
    result.ends = hn::Mul(share, hn::IfThenElse(passes, hn::Set(f, -ChordModel::kLeastEnds),
                                                hn::Set(f, 1.0F - ChordModel::kLeastEnds)));
    return result;
  }
};

/// What the readings of a tile say of cells that all of them pass.
struct PassedChord {
  using OfFace = ChordsOfFace;
  static constexpr bool kHolds = false;

  HWY_INLINE static SampleEvidence evaluate(const KernelParams& params, const DepthMeanTiles& tiles,
                                            const Sample& s, const OfFace& cell,
                                            const FaceSample& place) {
    const ReadingsAndChords r(params, tiles, s, cell, place);
    SampleEvidence result;
    result.log_odds = hn::Mul(r.least_log_odds(params), hn::Mul(r.length, r.readings.share));
    return result;
  }
};

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
