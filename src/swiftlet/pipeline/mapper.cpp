// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/pipeline/mapper.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet {
Expected<Mapper> Mapper::create(const MapperConfig& config, BlockArchive* archive) {
  if (auto faults = config.faults(); !faults.empty())
    return tl::make_unexpected(std::move(faults.front()));
  auto map = RollingMap::create(config.map);
  if (!map) return forward_error(std::move(map));
  auto conditioner = Conditioner::create(config.conditioning());
  if (!conditioner) return forward_error(std::move(conditioner));
  auto integrator = make_integrator(config.integrate);
  if (!integrator) return forward_error(std::move(integrator));
  return Mapper(config, archive, std::move(*map), std::move(*conditioner), std::move(*integrator));
}

Mapper::Mapper(const MapperConfig& config, BlockArchive* archive, RollingMap map,
               Conditioner conditioner, std::unique_ptr<Integrator> integrator)
    : config_(config),
      archive_(archive),
      map_(std::move(map)),
      gate_(std::make_unique<FrameGate>(config.quality)),
      conditioner_(std::move(conditioner)),
      integrator_(std::move(integrator)) {
  if (config.integrate.fusion != kThesisFusion) thin_ = std::make_unique<ThinHits>();
  if (config.integrate.decay_s > 0.0)
    decay_ = std::make_unique<GhostDecay>(config.integrate.decay_s);
}

std::optional<FrameVerdict> Mapper::refusal(const Frame& frame) {
  const auto& raw = frame.depth.raw;
  if (raw.width() != frame.intrinsics.width() || raw.height() != frame.intrinsics.height()) {
    return FrameVerdict::kSizeMismatch;
  }
  if (frame.T_world_camera.translation().cwiseAbs().maxCoeff() >= RollingMap::kMaxCoordinate_m) {
    return FrameVerdict::kPoseOutOfRange;
  }
  return gate_->refusal(frame);
}

MapUpdate Mapper::integrate(const Frame& frame) {
  MapUpdate update;
  StageTimer timer(update.times);
  if (const auto verdict = refusal(frame)) {
    update.verdict = *verdict;
    return update;
  }
  SensorOptions instrument = config_.sensor;
  if (frame.baseline_m > 0.0) instrument.baseline_m = frame.baseline_m;
  const StereoNoise noise{frame.intrinsics.fx(), instrument.baseline_m, instrument.subpixel_px};
  const ConditionedDepth& depth =
      conditioner_.clean(frame.depth, frame.intrinsics, noise.sigma_m(1.0));
  pyramid_.build(depth.raw);
  timer.finish(Stage::kCondition);
  if (pyramid_.readings() == 0) {
    update.verdict = FrameVerdict::kNoReadings;
    return update;
  }
  update.shift = map_.recentre(frame.T_world_camera.translation(), archive_);
  timer.finish(Stage::kRecentre);
  instrument.subpixel_px *= double{depth.noise_left};
  const auto shape =
      config_.integrate.fusion == kSharpFusion ? CellShape::kChord : CellShape::kSlice;
  const StereoSensor sensor(frame.intrinsics, instrument, map_.voxel_m(), depth.ratio, shape);
  const DepthView view{depth, pyramid_, frame.intrinsics, frame.T_world_camera, frame_count_};
  if (thin_) thin_->collect(view, map_);
  update.tally = integrator_->integrate(view, sensor, map_);
  if (thin_) thin_->protect(map_);
  if (decay_) {
    const double sigma_per_z2 = sensor.noise().sigma_m(1.0);
    update.decayed = decay_->apply(
        view, {frame.stamp, frame.camera, sigma_per_z2, config_.depth.max_range_m}, map_);
  }
  ++frame_count_;
  timer.finish(Stage::kIntegrate);
  update.was_published = map_.publish(frame_count_);
  timer.finish(Stage::kPublish);
  return update;
}

}  // namespace swiftlet
