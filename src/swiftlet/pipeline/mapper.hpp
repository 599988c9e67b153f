// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/integrate/measurement_model.hpp"
#include "swiftlet/integrate/upkeep/occupancy_decay.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/pipeline/frame_gate.hpp"
#include "swiftlet/pipeline/lookahead.hpp"
#include "swiftlet/pipeline/mapper_config.hpp"
#include "swiftlet/pipeline/stage_times.hpp"
#include "swiftlet/preprocess/preprocessor.hpp"

namespace swiftlet {

/// What one call of integrate() did.
struct MapUpdate {
  FrameVerdict verdict = FrameVerdict::kIntegrated;  ///< what became of the frame
  RollingMap::Shift shift;                           ///< what the window did
  /// Where the middle of the window should be: at the camera, or ahead of it (map.lookahead_s).
  Eigen::Vector3d window_goal = Eigen::Vector3d::Zero();
  IntegrationTally tally;     ///< what was summed, and into how much
  std::size_t decayed = 0;    ///< voxels that lost belief because nothing is seen where they are
  bool was_published = true;  ///< false: readers hold every snapshot slot, so they see an older map
  StageTimes times;           ///< of each stage
};

/// Depth frames with poses in, occupancy map out.
///
/// Thread safety: integrate() from one thread; any number of reader()s on others.
/// Real time: after the first frames no allocation, lock, file or log call; a frame that moves the
/// window calls the archive, if there is one.
class Mapper {
 public:
  /// `archive` takes what leaves the window and gives it back; null forgets it. It must outlive the
  /// mapper. Errors: kInvalidConfig (the first of config.faults(), or map.on_new_world is `clear`
  /// and there is an archive, which would give the old world back), kOutOfMemory.
  [[nodiscard]] static Expected<Mapper> create(const MapperConfig& config,
                                               BlockArchive* archive = nullptr);

  /// Fuses one frame. Frames of two worlds (Frame::pose_epoch) are never fused into one map, unless
  /// map.on_new_world says `keep`: those of a newer one are refused as kOtherWorld or, with
  /// `clear`, begin the map anew; those that come late, of an older one, are refused either way.
  MapUpdate integrate(const Frame& frame);

  /// Begins the map anew, for frames of this epoch: the same bits as those of a new mapper. Readers
  /// follow. REQUIRES: the archive, if there is one, gives back no more blocks of the old world.
  void begin_world(std::uint32_t pose_epoch);

  /// As given.
  [[nodiscard]] const MapperConfig& config() const { return config_; }
  /// For the mapping thread.
  [[nodiscard]] const RollingMap& map() const { return map_; }
  /// For the mapping thread.
  [[nodiscard]] RollingMap& map() { return map_; }
  /// For another thread: follows the map while it grows.
  [[nodiscard]] MapReader reader() const { return map_.reader(); }
  /// For the mapping thread: the map as it is now, with its stamp, pose and thresholds; nullopt if
  /// readers hold every slot.
  [[nodiscard]] std::optional<MapSnapshot> snapshot() { return map_.snapshot(mark_); }

  /// Frames integrated so far.
  [[nodiscard]] std::uint64_t frame_count() const { return mark_.frame_count; }
  /// The window and the scratch of what integrates [bytes].
  [[nodiscard]] std::size_t memory_bytes() const {
    return map_.memory_bytes() + pyramid_.memory_bytes() + model_->memory_bytes() +
           integrator_->memory_bytes();
  }

 private:
  Mapper(const MapperConfig& config, BlockArchive* archive, RollingMap map,
         Preprocessor preprocessor, MeasurementModelPtr model,
         std::unique_ptr<Integrator> integrator);
  [[nodiscard]] std::optional<FrameVerdict> refusal(const Frame& frame);
  [[nodiscard]] bool is_of_other_world(const Frame& frame) const;
  void enter_world_of(const Frame& frame);
  [[nodiscard]] SensorOptions instrument_of(const Frame& frame) const;
  [[nodiscard]] Eigen::Vector3d window_goal(const Frame& frame);
  void fuse(const Frame& frame, const SensorOptions& instrument, const PreprocessedDepth& depth,
            MapUpdate& update);

  MapperConfig config_;
  bool clears_for_new_world_;
  bool keeps_in_new_world_;
  std::optional<std::uint32_t> pose_epoch_;  // of what is in the map; none before the first frame
  BlockArchive* archive_;
  RollingMap map_;
  std::unique_ptr<FrameGate> gate_;
  Preprocessor preprocessor_;
  DepthRangePyramid pyramid_;
  MeasurementModelPtr model_;
  std::unique_ptr<Integrator> integrator_;
  std::unique_ptr<OccupancyDecay> decay_;  // null: never
  /// Null: the window stays around the vehicle.
  std::unique_ptr<Lookahead> lookahead_;
  FrameMark mark_;  // the newest frame in the map
};

}  // namespace swiftlet
