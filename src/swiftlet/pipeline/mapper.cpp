// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/pipeline/mapper.hpp"

#include <algorithm>
#include <utility>

#include "swiftlet/integrate/measurement_models.hpp"

namespace swiftlet {

Expected<Mapper> Mapper::create(const MapperConfig& config, BlockArchive* archive) {
  if (auto faults = config.faults(); !faults.empty())
    return tl::make_unexpected(std::move(faults.front()));
  if (config.on_new_world == NewWorldRule::kClear && archive != nullptr) {
    return fail(ErrorCode::kInvalidConfig, "map.on_new_world",
                "an archive would bring the blocks of the old world back into the cleared map",
                "choose 'refuse', and call begin_world() when the archive is a new one, too");
  }
  auto map = RollingMap::create(config.map, config.scale());
  if (!map) return forward_error(std::move(map));
  auto preprocessor = Preprocessor::create(config.preprocessing());
  if (!preprocessor) return forward_error(std::move(preprocessor));
  const auto model = find_measurement_model(config.integrate.model);
  if (!model) return tl::make_unexpected(model.error());
  auto integrator = make_integrator(config.integrate);
  if (!integrator) return forward_error(std::move(integrator));
  return Mapper(config, archive, std::move(*map), std::move(*preprocessor), model->make(),
                std::move(*integrator));
}

Mapper::Mapper(const MapperConfig& config, BlockArchive* archive, RollingMap map,
               Preprocessor preprocessor, MeasurementModelPtr model,
               std::unique_ptr<Integrator> integrator)
    : config_(config),
      clears_for_new_world_(config.on_new_world == NewWorldRule::kClear),
      keeps_in_new_world_(config.on_new_world == NewWorldRule::kKeep),
      archive_(archive),
      map_(std::move(map)),
      gate_(std::make_unique<FrameGate>(config.quality)),
      preprocessor_(std::move(preprocessor)),
      model_(std::move(model)),
      integrator_(std::move(integrator)) {
  if (config.integrate.decay_s > 0.0)
    decay_ = std::make_unique<OccupancyDecay>(config.integrate.decay_s);
  if (config.window.lookahead_s > 0.0)
    lookahead_ = std::make_unique<Lookahead>(config.window, config.map);
}

void Mapper::begin_world(std::uint32_t pose_epoch) {
  map_.clear();
  *gate_ = FrameGate(config_.quality);
  if (decay_) *decay_ = OccupancyDecay(config_.integrate.decay_s);
  mark_ = {};  // rounding draws from the number of frames
  pose_epoch_ = pose_epoch;
  map_.publish(mark_);
}

bool Mapper::is_of_other_world(const Frame& frame) const {
  if (keeps_in_new_world_ || !pose_epoch_ || frame.pose_epoch == *pose_epoch_) return false;
  return !clears_for_new_world_ || frame.pose_epoch < *pose_epoch_;
}

/// REQUIRES: the frame is not of another world, so a newer epoch is one to clear for.
void Mapper::enter_world_of(const Frame& frame) {
  if (keeps_in_new_world_) return;
  if (pose_epoch_ && frame.pose_epoch != *pose_epoch_) begin_world(frame.pose_epoch);
  pose_epoch_ = frame.pose_epoch;
}

std::optional<FrameVerdict> Mapper::refusal(const Frame& frame) {
  if (is_of_other_world(frame)) return FrameVerdict::kOtherWorld;
  const auto& raw = frame.depth.raw;
  if (raw.width() != frame.intrinsics.width() || raw.height() != frame.intrinsics.height()) {
    return FrameVerdict::kSizeMismatch;
  }
  if (frame.T_world_camera.translation().cwiseAbs().maxCoeff() >= RollingMap::kMaxCoordinate_m) {
    return FrameVerdict::kPoseOutOfRange;
  }
  return gate_->refusal(frame);
}

/// What is known of the camera, by the frame itself where it tells more.
SensorOptions Mapper::instrument_of(const Frame& frame) const {
  SensorOptions instrument = config_.sensor;
  if (frame.baseline_m > 0.0) instrument.baseline_m = frame.baseline_m;
  return instrument;
}

Eigen::Vector3d Mapper::window_goal(const Frame& frame) {
  return lookahead_ ? lookahead_->middle_for(frame) : frame.T_world_camera.translation();
}

MapUpdate Mapper::integrate(const Frame& frame) {
  MapUpdate update;
  StageTimer timer(update.times);
  if (const auto verdict = refusal(frame)) {
    update.verdict = *verdict;
    return update;
  }
  const SensorOptions instrument = instrument_of(frame);
  const PreprocessedDepth& depth = preprocessor_.clean(
      frame.depth, frame.intrinsics, stereo_noise(frame.intrinsics, instrument).sigma_m(1.0));
  pyramid_.build(depth.raw);
  timer.finish(Stage::kPreprocess);
  if (pyramid_.readings() == 0) {
    update.verdict = FrameVerdict::kNoReadings;
    return update;
  }
  enter_world_of(frame);  // only now: a frame without use clears nothing
  update.window_goal = window_goal(frame);
  update.shift = map_.recentre(update.window_goal, archive_);
  timer.finish(Stage::kRecentre);
  fuse(frame, instrument, depth, update);
  timer.finish(Stage::kIntegrate);
  update.was_published = map_.publish(mark_);
  timer.finish(Stage::kPublish);
  return update;
}

void Mapper::fuse(const Frame& frame, const SensorOptions& instrument,
                  const PreprocessedDepth& depth, MapUpdate& update) {
  SensorOptions left = instrument;
  left.subpixel_px *= double{depth.noise_left};
  const StereoSensor sensor(frame.intrinsics, left, map_.voxel_m(), depth.ratio);
  const DepthView view{depth, pyramid_, frame.intrinsics, frame.T_world_camera, mark_.frame_count};
  update.tally = integrator_->integrate(view, sensor, *model_, map_);
  if (decay_) {
    const double sigma_per_z2 = sensor.noise().sigma_m(1.0);
    update.decayed = decay_->apply(
        view, {frame.stamp, frame.camera, sigma_per_z2, config_.depth.max_range_m}, map_);
  }
  mark_ = {mark_.frame_count + 1, frame.stamp, frame.T_world_camera};
}

}  // namespace swiftlet
