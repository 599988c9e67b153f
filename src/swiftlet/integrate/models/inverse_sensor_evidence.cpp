// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/models/inverse_sensor_evidence.hpp"

#include <cmath>

#include "swiftlet/integrate/evidence_sums.hpp"
#include "swiftlet/integrate/rays/ray_in_view.hpp"

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/models/inverse_sensor_evidence.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "swiftlet/integrate/projective/free_voxels_private.hpp"
#include "swiftlet/integrate/projective/sampled_voxels_private.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

HWY_INLINE FloatLanes within_reach(FloatLanes d) {
  constexpr Floats f;
  const FloatLanes reach = hn::Set(f, EvidenceTable::kReach);
  return hn::Min(hn::Max(d, hn::Neg(reach)), reach);
}

/// What is left of a tile's evidence when the readings are left out whose band ends before their
/// rays enter the voxel, which is `inset` behind the near side of its slice. Up to a deviation of
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

/// What the kernels need to know of a voxel: the depth of its centre.
struct CentreOfFace {
  FloatLanes z;

  HWY_INLINE CentreOfFace() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
  HWY_INLINE CentreOfFace(const KernelParams&, const VoxelLanes& voxels, std::size_t)
      : z(voxels.camera[2]) {}
};

/// What the readings of a tile say of the voxels by InverseSensorModel: nothing if their band ends
/// before their rays enter.
struct SliceEvidence {
  using OfFace = CentreOfFace;
  static constexpr bool kMarksNotFree = false;

  HWY_INLINE static SampleEvidence evaluate(const KernelParams& params, const DepthMeanTiles& tiles,
                                            const Sample& s, const OfFace& voxel,
                                            const FaceSample&) {
    constexpr Floats f;
    constexpr Ints i;
    const Readings readings = readings_at(tiles, s.tile);
    const FloatLanes per_z = readings.per_z, narrow = readings.narrow;

    // Distances behind the readings' mean m in their deviations: (z - m) / sigma with sigma = a m^2
    // is (z / m - 1) / (a m).
    const FloatLanes one = hn::Set(f, 1.0F);
    const FloatLanes scale = hn::Mul(per_z, hn::Set(f, params.per_sigma));
    const FloatLanes centre = hn::Mul(scale, hn::Sub(hn::Mul(voxel.z, per_z), one));
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
    const FloatLanes log_odds = hn::GatherIndex(f, params.model.table, place);

    const FloatLanes reach = hn::Set(f, EvidenceTable::kReachSigma);
    const FloatLanes inset = hn::Sub(entry, hn::Sub(centre, half));
    SampleEvidence result;
    result.log_odds =
        hn::Mul(hn::Mul(log_odds, readings.share), reaching(hn::Sub(reach, entry), inset, narrow));
    return result;
  }
};

/// What the readings of a tile say of voxels that all of them pass.
struct PassedSlice {
  using OfFace = CentreOfFace;
  static constexpr bool kMarksNotFree = false;

  HWY_INLINE static SampleEvidence evaluate(const KernelParams& params, const DepthMeanTiles& tiles,
                                            const Sample& s, const OfFace&, const FaceSample&) {
    constexpr Floats f;
    const FloatLanes share = share_of(hn::GatherIndex(Ints(), tiles.words, s.tile));
    SampleEvidence result;
    result.log_odds = hn::Mul(share, hn::Set(f, params.model.free_log_odds));
    return result;
  }
};

struct FreeSlice {
  /// Observations that voxels get from a frame whose every pixel is a ray through them to beyond:
  /// DW times the area of their image. A patch dA of a face at q with normal n covers |n q| / q_z^3
  /// dA of the plane z = 1; over one face |n q| is constant, and 1 / q_z^3 averages to 1 / z^3 (1 +
  /// 6 var(q_z) / z^2) around its middle.
  HWY_INLINE static FloatLanes observations(const KernelParams& params, const VoxelLanes& voxels) {
    constexpr Floats f;
    const FloatLanes half = hn::Set(f, 0.5F * params.voxel_m);
    FloatLanes sum = hn::Zero(f);
    for (int i = 0; i < 3; ++i) {
      const float along = params.world_axis[i][2];
      // Depth over a face is uniform along its two edges: variance (a_j^2 + a_k^2) c^2 / 12.
      const float spread = 0.5F * (1.0F - along * along) * params.voxel_m * params.voxel_m;
      const FloatLanes distance = hn::Max(hn::Zero(f), hn::Sub(hn::Abs(voxels.world[i]), half));
      const FloatLanes to_face = hn::Mul(hn::CopySign(half, voxels.world[i]), hn::Set(f, along));
      const FloatLanes per_z = hn::Div(hn::Set(f, 1.0F), hn::Sub(voxels.camera[2], to_face));
      const FloatLanes per_z2 = hn::Mul(per_z, per_z);
      const FloatLanes bend = hn::Add(hn::Set(f, 1.0F), hn::Mul(hn::Set(f, spread), per_z2));
      sum = hn::Add(sum, hn::Mul(hn::Mul(distance, hn::Mul(per_z, per_z2)), bend));
    }
    return hn::Mul(sum, hn::Mul(voxels.camera[2], voxels.camera[2]));
  }
};

void free_slices(const KernelParams& params, const VoxelCube& cube, FixedSteps* evidence) {
  fill_free_voxels<FreeSlice>(params, cube, evidence);
}
void passed_slices(const KernelParams& params, const VoxelCube& block, const VoxelList& voxels,
                   const VoxelLook& look, FixedSteps* evidence) {
  fill_sampled_voxels<PassedSlice>(params, block, voxels, look, evidence);
}
void sampled_slices(const KernelParams& params, const VoxelCube& block, const VoxelList& voxels,
                    const VoxelLook& look, FixedSteps* evidence) {
  fill_sampled_voxels<SliceEvidence>(params, block, voxels, look, evidence);
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {

HWY_EXPORT(free_slices);
HWY_EXPORT(passed_slices);
HWY_EXPORT(sampled_slices);

void InverseSensorEvidence::begin_frame(const DepthView& /*view*/, const StereoSensor& sensor,
                                        const RollingMap& /*map*/) {
  sensor_ = sensor;
}

double InverseSensorEvidence::ray_end_m(double z_m) const {
  return z_m + InverseSensorModel::kBandSigma * sensor_->noise().sigma_m(z_m);
}

void InverseSensorEvidence::add_ray(const RayInView& ray, std::span<const VoxelIndex> voxels,
                                    EvidenceSums& sums) const {
  const double sigma_m = sensor_->noise().sigma_m(ray.z_m);
  for (const VoxelIndex& voxel : voxels) {
    const double z_voxel_m = ray.geometry.depth_of(voxel);
    if (z_voxel_m <= 0.0) continue;  // the camera's own voxel, its centre behind the lens
    const double log_odds = sensor_->log_odds(z_voxel_m, ray.z_m, sigma_m);
    if (log_odds != 0.0) sums.add_log_odds(voxel, sensor_->weight(z_voxel_m) * log_odds);
  }
}

ModelParams InverseSensorEvidence::prepare(const CubeView& view, float farthest_m) {
  table_.prepare(*sensor_, view.voxel_m(), farthest_m);
  const Float3& a = view.optical_axis();
  const float across_voxels = std::abs(a[0]) + std::abs(a[1]) + std::abs(a[2]);
  // From the nearest point of a voxel's cube to the nearest of its slice.
  const float inset_m = 0.5F * view.voxel_m() * (across_voxels - 1.0F);
  const auto free_log_odds = static_cast<float>(sensor_->model().free_log_odds());
  return {.hidden_m = -inset_m,
          .passed_m = -inset_m,
          .clear_m = -inset_m,
          .reach_sigma = EvidenceTable::kReachSigma,
          .in_front_sigma = EvidenceTable::kInFrontSigma,
          .free_log_odds = free_log_odds,
          .clear_log_odds = free_log_odds,
          .table = table_.log_odds()};
}

void InverseSensorEvidence::fill_free(const KernelParams& params, const VoxelCube& cube,
                                      FixedSteps* evidence) const {
  HWY_DYNAMIC_DISPATCH(free_slices)(params, cube, evidence);
}

void InverseSensorEvidence::fill_passed(const KernelParams& params, const VoxelCube& block,
                                        const VoxelList& voxels, const VoxelLook& look,
                                        FixedSteps* evidence) const {
  HWY_DYNAMIC_DISPATCH(passed_slices)(params, block, voxels, look, evidence);
}

void InverseSensorEvidence::fill_sampled(const KernelParams& params, const VoxelCube& block,
                                         const VoxelList& voxels, const VoxelLook& look,
                                         FixedSteps* evidence) const {
  HWY_DYNAMIC_DISPATCH(sampled_slices)(params, block, voxels, look, evidence);
}

MeasurementModelPtr make_inverse_sensor_model() {
  return std::make_unique<InverseSensorEvidence>();
}

}  // namespace swiftlet
#endif
