// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Voxels that look at their readings, whatever these say of them by the model at hand. Included
// once for every instruction set, so there is no #pragma once but Highway's toggle.
#if defined(SWIFTLET_SAMPLED_VOXELS_PRIVATE) == defined(HWY_TARGET_TOGGLE)
#ifdef SWIFTLET_SAMPLED_VOXELS_PRIVATE
#undef SWIFTLET_SAMPLED_VOXELS_PRIVATE
#else
#define SWIFTLET_SAMPLED_VOXELS_PRIVATE
#endif

#include <algorithm>

#include "swiftlet/integrate/projective/tile_evidence_private.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

/// Voxels are asked in groups of so many, in as many vectors as that takes on this machine.
constexpr std::size_t kGroup = VoxelList::kSpare;
constexpr std::size_t kVectors = kGroup / hn::MaxLanes(Floats());
/// Where the first few samples of a face say the same [log-odds], for each voxel of a group, the
/// others would, too.
constexpr std::size_t kFew = 4;
constexpr float kFlat = 0.015F;

/// One face of each of several voxels, and what the samples on it say so far.
template <class Model>
struct Face {
  FloatLanes middle[3];
  typename Model::OfFace voxel;
  FloatLanes sum, least, most, ends;

  HWY_INLINE Face() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
  HWY_INLINE Face(const KernelParams& params, const VoxelLanes& voxels, std::size_t axis)
      : voxel(params, voxels, axis) {
    constexpr Floats f;
    const FloatLanes to_face = hn::CopySign(hn::Set(f, 0.5F * params.voxel_m), voxels.world[axis]);
    for (int i = 0; i < 3; ++i) {
      middle[i] =
          hn::Sub(voxels.camera[i], hn::Mul(to_face, hn::Set(f, params.world_axis[axis][i])));
    }
    sum = ends = hn::Zero(f);
    least = hn::Set(f, 1e9F);
    most = hn::Neg(least);
  }

  template <bool IsInside>
  HWY_INLINE void add(const KernelParams& params, const VoxelLook& look, const FaceSample& place) {
    const Sample s = sample_at<IsInside>(params, look.tiles, middle, place.to);
    const FloatLanes rays = hn::Mul(s.per_z, hn::Mul(s.per_z, s.per_z));
    SampleEvidence result = Model::evaluate(params, look.tiles, s, voxel, place);
    if constexpr (!IsInside) {
      result.log_odds = hn::IfThenElseZero(s.is_inside, result.log_odds);
      result.ends = hn::IfThenElseZero(s.is_inside, result.ends);
    }
    sum = hn::Add(sum, hn::Mul(rays, result.log_odds));
    if constexpr (Model::kMarksNotFree) ends = hn::Add(ends, hn::Mul(rays, result.ends));
    least = hn::Min(least, result.log_odds);
    most = hn::Max(most, result.log_odds);
  }

  [[nodiscard]] HWY_INLINE bool is_flat() const {
    constexpr Floats f;
    return hn::AllTrue(f, hn::Lt(hn::Sub(most, least), hn::Set(f, kFlat * DepthMeanTiles::kAll)));
  }
};

/// What the faces of a vector of voxels say together.
struct Sums {
  FloatLanes log_odds, ends;

  HWY_INLINE Sums() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
};

/// The sum over rays as an integral over the faces that the camera sees: each is crossed by
/// |n q| / q_z^3 rays per area, and a ray counts DW, z^2 times a constant that the area cancels.
/// Adds one face's part to the sums of a group of voxels.
template <class Model, bool IsInside>
HWY_INLINE void add_face(const KernelParams& params, const VoxelLook& look,
                         const VoxelLanes* voxels, std::size_t axis, Sums* sums) {
  constexpr Floats f;
  Face<Model> faces[kVectors];
  for (std::size_t v = 0; v < kVectors; ++v) faces[v] = Face<Model>(params, voxels[v], axis);
  const std::span<const FaceSample> places = look.samples.on_face(axis);
  std::size_t count = std::min(places.size(), kFew);
  bool is_flat = true;
  for (Face<Model>& face : faces) {
    for (std::size_t k = 0; k < count; ++k) face.template add<IsInside>(params, look, places[k]);
    is_flat = is_flat && face.is_flat();
  }
  if (!is_flat) {
    for (Face<Model>& face : faces) {
      for (const FaceSample& place : places.subspan(count))
        face.template add<IsInside>(params, look, place);
    }
    count = places.size();
  }
  const FloatLanes per_count =
      hn::Set(f, 1.0F / (DepthMeanTiles::kAll * static_cast<float>(count)));
  for (std::size_t v = 0; v < kVectors; ++v) {
    const FloatLanes half = hn::Set(f, 0.5F * params.voxel_m);
    const FloatLanes distance = hn::Max(hn::Zero(f), hn::Sub(hn::Abs(voxels[v].world[axis]), half));
    const FloatLanes share = hn::Mul(distance, per_count);
    sums[v].log_odds = hn::Add(sums[v].log_odds, hn::Mul(share, faces[v].sum));
    if constexpr (Model::kMarksNotFree)
      sums[v].ends = hn::Add(sums[v].ends, hn::Mul(share, faces[v].ends));
  }
}

template <class Model, bool IsInside>
HWY_INLINE void fill_voxels(const KernelParams& params, const VoxelCube& block,
                            const VoxelList& list, const VoxelLook& look, FixedSteps* evidence) {
  constexpr Floats f;
  constexpr Ints i;
  const std::size_t lanes = hn::Lanes(f);
  for (std::size_t k = 0; k < list.count; k += kGroup) {
    VoxelLanes voxels[kVectors];
    Sums sums[kVectors];
    for (std::size_t v = 0; v < kVectors; ++v) {
      const std::size_t at = k + v * lanes;
      voxels[v] = voxels_at(params, block, hn::LoadU(f, &list.x[at]), hn::LoadU(f, &list.y[at]),
                            hn::LoadU(f, &list.z[at]));
      sums[v].log_odds = sums[v].ends = hn::Zero(f);
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
      add_face<Model, IsInside>(params, look, voxels, axis, sums);
    HWY_ALIGN FixedSteps steps[kGroup];
    for (std::size_t v = 0; v < kVectors; ++v) {
      const FloatLanes z = hn::Max(hn::Zero(f), voxels[v].camera[2]);
      IntLanes all = fixed_steps(params, hn::Mul(sums[v].log_odds, hn::Mul(z, z)));
      if constexpr (Model::kMarksNotFree) {
        const auto ends = hn::RebindMask(i, hn::Gt(sums[v].ends, hn::Zero(f)));
        const auto is_not_free = hn::And(ends, hn::Lt(all, hn::Zero(i)));
        all = hn::Or(all, hn::IfThenElseZero(is_not_free, hn::Set(i, kNotFree)));
      }
      hn::Store(all, i, steps + v * lanes);
    }
    const std::size_t here = std::min(kGroup, list.count - k);
    for (std::size_t lane = 0; lane < here; ++lane) evidence[list.offset[k + lane]] = steps[lane];
  }
}

/// Writes the evidence of listed voxels. A Model of one sample has
///
///   OfFace         what it wants to know of a face of a voxel, made of (params, voxels, axis)
///   kMarksNotFree  whether its evidence has `ends`, which may mark a voxel as not free
///   evaluate()     the SampleEvidence of a tile of readings about voxels whose rays end in it
template <class Model>
HWY_INLINE void fill_sampled_voxels(const KernelParams& params, const VoxelCube& block,
                                    const VoxelList& voxels, const VoxelLook& look,
                                    FixedSteps* evidence) {
  if (look.is_inside_image) {
    fill_voxels<Model, true>(params, block, voxels, look, evidence);
  } else {
    fill_voxels<Model, false>(params, block, voxels, look, evidence);
  }
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
