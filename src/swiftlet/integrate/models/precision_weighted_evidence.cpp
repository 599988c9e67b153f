// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <optional>

#include "swiftlet/integrate/evidence_sums.hpp"
#include "swiftlet/integrate/models/thin_obstacle_preserving.hpp"
#include "swiftlet/integrate/rays/ray_in_view.hpp"
#include "swiftlet/sensor/precision_weighted_model.hpp"

// Highway compiles this file once for every instruction set: SSE2 to AVX-512, NEON.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "swiftlet/integrate/models/precision_weighted_evidence.cpp"
#include <hwy/foreach_target.h>  // must come before highway.h
#include <hwy/highway.h>

#include "swiftlet/integrate/projective/free_voxels_private.hpp"
#include "swiftlet/integrate/projective/sampled_voxels_private.hpp"

HWY_BEFORE_NAMESPACE();
namespace swiftlet::HWY_NAMESPACE {  // NOLINT(readability-identifier-naming): Highway's
namespace {

/// Where rays that enter voxels by one face leave them. A ray passes the plane at distance d along
/// an axis at e / d of the depth at which it passes d, so the plane that it meets first is the one
/// with the largest share e / d, where e is the place of its entry.
struct IntersectionsOfFace {
  FloatLanes opposite_share;              // z_in / z of the plane opposite to the face
  FloatLanes world_j, world_k;            // of the middle of the face [m]
  FloatLanes per_far_j[2], per_far_k[2];  // 1 / the places of the other planes: lower, upper

  HWY_INLINE IntersectionsOfFace() {}  // NOLINT(modernize-use-equals-default): see FloatLanes
  HWY_INLINE IntersectionsOfFace(const KernelParams& params, const VoxelLanes& voxels,
                                 std::size_t axis)
      : world_j(voxels.world[(axis + 1) % 3]), world_k(voxels.world[(axis + 2) % 3]) {
    constexpr Floats f;
    const FloatLanes half = hn::Set(f, 0.5F * params.voxel_m), one = hn::Set(f, 1.0F);
    const FloatLanes across = hn::Abs(voxels.world[axis]);
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

  /// Depth [m] at which the ray of a sample leaves its voxel.
  [[nodiscard]] HWY_INLINE FloatLanes z_out(FloatLanes z_in, const FaceSample& place) const {
    constexpr Floats f;
    const auto share = [](FloatLanes e, const FloatLanes* per_far) {
      return hn::Mul(e, hn::IfThenElse(hn::Lt(e, hn::Zero(Floats())), per_far[0], per_far[1]));
    };
    const FloatLanes e_j = hn::Add(world_j, hn::Set(f, place.along_j));
    const FloatLanes e_k = hn::Add(world_k, hn::Set(f, place.along_k));
    const FloatLanes most =
        hn::Max(opposite_share, hn::Max(share(e_j, per_far_j), share(e_k, per_far_k)));
    // Of a voxel that the camera stands in nearly all is left; the last bound holds against
    // rounding.
    constexpr float kLeastShare = 0.01F;
    return hn::Div(z_in, hn::Min(hn::Max(most, hn::Set(f, kLeastShare)), hn::Set(f, 1.0F)));
  }
};

/// The readings of a tile, and where the rays that end in it cross their voxels.
struct ReadingsAndIntersections {
  Readings readings;
  FloatLanes z_out;      // where the rays leave their voxels [m]
  FloatLanes length;     // of the intersections [voxels]
  FloatLanes per_sigma;  // 1 / the deviation of the readings, in units of their depth

  HWY_INLINE ReadingsAndIntersections(const KernelParams& params, const DepthMeanTiles& tiles,
                                      const Sample& s, const IntersectionsOfFace& voxel,
                                      const FaceSample& place)
      : readings(readings_at(tiles, s.tile)), z_out(voxel.z_out(s.z, place)) {
    constexpr Floats f;
    length = hn::Mul(hn::Sub(z_out, s.z), hn::Set(f, 1.0F / params.voxel_m));
    per_sigma = hn::Mul(hn::Mul(readings.per_z, hn::Set(f, params.per_sigma)), readings.narrow);
  }

  /// How far x [m] lies behind the readings, in units of their depth: with sigma = a z^2,
  /// (x - z) / sigma is (x / z - 1) / (a z), this times per_sigma.
  [[nodiscard]] HWY_INLINE FloatLanes behind(FloatLanes x) const {
    return hn::Sub(hn::Mul(x, readings.per_z), hn::Set(Floats(), 1.0F));
  }

  /// The least that the readings say of the voxels.
  [[nodiscard]] HWY_INLINE FloatLanes least_log_odds(const KernelParams& params) const {
    constexpr Floats f;
    const FloatLanes sigmas =
        hn::Mul(behind(hn::Add(z_out, hn::Set(f, params.model.clear_m))), per_sigma);
    const auto is_clear = hn::Lt(sigmas, hn::Set(f, -PrecisionWeightedModel::kClearSigma));
    return hn::IfThenElse(is_clear, hn::Set(f, params.model.clear_log_odds),
                          hn::Set(f, params.model.free_log_odds));
  }
};

/// What the readings of a tile say of the voxels by PrecisionWeightedModel.
struct IntersectionEvidence {
  using OfFace = IntersectionsOfFace;
  static constexpr bool kMarksNotFree = true;

  HWY_INLINE static SampleEvidence evaluate(const KernelParams& params, const DepthMeanTiles& tiles,
                                            const Sample& s, const OfFace& voxel,
                                            const FaceSample& place) {
    constexpr Floats f;
    const ReadingsAndIntersections r(params, tiles, s, voxel, place);
    const FloatLanes one = hn::Set(f, 1.0F), zero = hn::Zero(f);
    const FloatLanes gain =
        hn::Mul(hn::Mul(hn::Mul(r.per_sigma, r.per_sigma), r.readings.per_z),
                hn::Set(f, PrecisionWeightedModel::kIndependence * params.voxel_m));
    const FloatLanes middle = hn::Mul(hn::Add(s.z, r.z_out), hn::Set(f, 0.5F));
    const FloatLanes ratio =
        hn::Min(hn::Max(hn::Mul(gain, r.behind(middle)), r.least_log_odds(params)),
                hn::Set(f, PrecisionWeightedModel::kMostLogOdds));

    const FloatLanes hiding = hn::Set(f, PrecisionWeightedModel::kHidingVoxels * params.voxel_m);
    const FloatLanes before = hn::Mul(r.behind(hn::Sub(s.z, hiding)), r.per_sigma);
    const FloatLanes left = hn::Min(
        hn::Max(hn::Sub(hn::Set(f, PrecisionWeightedModel::kFadeSigma), before), zero), one);
    const auto is_reached = hn::Gt(left, zero);
    const FloatLanes fading = hn::IfThenElse(hn::Gt(ratio, zero), left, one);
    const FloatLanes share = hn::IfThenElseZero(is_reached, r.readings.share);
    SampleEvidence result;
    result.log_odds = hn::Mul(hn::Mul(ratio, fading), hn::Mul(r.length, share));

    const FloatLanes end = hn::Set(f, PrecisionWeightedModel::kEndVoxels * params.voxel_m);
    const auto passes = hn::Lt(r.behind(hn::Add(r.z_out, end)), zero);
    result.ends =
        hn::Mul(share, hn::IfThenElse(passes, hn::Set(f, -PrecisionWeightedModel::kLeastEnds),
                                      hn::Set(f, 1.0F - PrecisionWeightedModel::kLeastEnds)));
    return result;
  }
};

/// What the readings of a tile say of voxels that all of them pass.
struct PassedIntersection {
  using OfFace = IntersectionsOfFace;
  static constexpr bool kMarksNotFree = false;

  HWY_INLINE static SampleEvidence evaluate(const KernelParams& params, const DepthMeanTiles& tiles,
                                            const Sample& s, const OfFace& voxel,
                                            const FaceSample& place) {
    const ReadingsAndIntersections r(params, tiles, s, voxel, place);
    SampleEvidence result;
    result.log_odds = hn::Mul(r.least_log_odds(params), hn::Mul(r.length, r.readings.share));
    return result;
  }
};

struct FreeIntersection {
  /// The mean of DW over the volume of a voxel, as the intersections of all rays fill it.
  HWY_INLINE static FloatLanes observations(const KernelParams&, const VoxelLanes&) {
    return hn::Set(Floats(), 1.0F);
  }
};

void free_voxels(const KernelParams& params, const VoxelCube& cube, FixedSteps* evidence) {
  fill_free_voxels<FreeIntersection>(params, cube, evidence);
}
void passed_voxels(const KernelParams& params, const VoxelCube& block, const VoxelList& voxels,
                   const VoxelLook& look, FixedSteps* evidence) {
  fill_sampled_voxels<PassedIntersection>(params, block, voxels, look, evidence);
}
void sampled_voxels(const KernelParams& params, const VoxelCube& block, const VoxelList& voxels,
                    const VoxelLook& look, FixedSteps* evidence) {
  fill_sampled_voxels<IntersectionEvidence>(params, block, voxels, look, evidence);
}

}  // namespace
}  // namespace swiftlet::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace swiftlet {
namespace {

HWY_EXPORT(free_voxels);
HWY_EXPORT(passed_voxels);
HWY_EXPORT(sampled_voxels);

/// A cube is clearly passed by readings that lie so many deviations behind it: of these each would
/// say by itself that it is clear.
constexpr float kInFrontSigma = 5.0F;
static_assert(PrecisionWeightedModel::kClearSigma <= kInFrontSigma);

/// Evidence by PrecisionWeightedModel: a frame gives a voxel DW * L * the length of the
/// intersection for each reading whose ray crosses it.
class PrecisionWeightedEvidence : public MeasurementModel {
 public:
  void begin_frame(const DepthView& /*view*/, const StereoSensor& sensor,
                   const RollingMap& map) override {
    sensor_ = sensor;
    model_ = PrecisionWeightedModel(map.voxel_m(), sensor.model().free_log_odds());
    voxel_m_ = map.voxel_m();
  }

  [[nodiscard]] double ray_end_m(double z_m) const override {
    return z_m + double{PrecisionWeightedModel::kFadeSigma} * sensor_->noise().sigma_m(z_m) +
           double{PrecisionWeightedModel::kHidingVoxels} * voxel_m_;
  }

  void add_ray(const RayInView& ray, std::span<const VoxelIndex> voxels,
               EvidenceSums& sums) const override {
    const double sigma_m = sensor_->noise().sigma_m(ray.z_m);
    for (const VoxelIndex& voxel : voxels) {
      const double z_voxel_m = ray.geometry.depth_of(voxel);
      if (z_voxel_m <= 0.0) continue;  // the camera's own voxel, its centre behind the lens
      const RayIntersection crossed = ray.geometry.intersection(ray.direction, voxel);
      const auto evidence = model_->evaluate(crossed.z_in_m, crossed.z_out_m, ray.z_m, sigma_m);
      const double weight = sensor_->weight(z_voxel_m);
      sums.add_log_odds(voxel, weight * crossed.length_voxels * evidence.log_odds);
      sums.add_ends(voxel, weight * evidence.ends);
    }
  }

  [[nodiscard]] ModelParams prepare(const CubeView& view, float /*farthest_m*/) override {
    const auto free_log_odds = static_cast<float>(sensor_->model().free_log_odds());
    return {.hidden_m = PrecisionWeightedModel::kHidingVoxels * view.voxel_m(),
            .passed_m = PrecisionWeightedModel::kEndVoxels * view.voxel_m(),
            .clear_m = PrecisionWeightedModel::kClearVoxels * view.voxel_m(),
            .reach_sigma = PrecisionWeightedModel::kFadeSigma,
            .in_front_sigma = kInFrontSigma,
            .free_log_odds = free_log_odds,
            .clear_log_odds = PrecisionWeightedModel::kClearGain * free_log_odds};
  }

  void fill_free(const KernelParams& params, const VoxelCube& cube,
                 FixedSteps* evidence) const override {
    HWY_DYNAMIC_DISPATCH(free_voxels)(params, cube, evidence);
  }
  void fill_passed(const KernelParams& params, const VoxelCube& block, const VoxelList& voxels,
                   const VoxelLook& look, FixedSteps* evidence) const override {
    HWY_DYNAMIC_DISPATCH(passed_voxels)(params, block, voxels, look, evidence);
  }
  void fill_sampled(const KernelParams& params, const VoxelCube& block, const VoxelList& voxels,
                    const VoxelLook& look, FixedSteps* evidence) const override {
    HWY_DYNAMIC_DISPATCH(sampled_voxels)(params, block, voxels, look, evidence);
  }

 private:
  // Of this frame.
  std::optional<StereoSensor> sensor_;
  std::optional<PrecisionWeightedModel> model_;
  double voxel_m_ = 0.0;
};

}  // namespace

MeasurementModelPtr make_precision_weighted() {
  return std::make_unique<ThinObstaclePreserving<PrecisionWeightedEvidence>>();
}

}  // namespace swiftlet
#endif
