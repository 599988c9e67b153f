// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/live/live_sink.hpp"
#include "swiftlet/source/rig/real_time_source.hpp"
#include "swiftlet/source/rig/rig.hpp"
#include "swiftlet/source/rig/rig_gates.hpp"

namespace swiftlet {

/// A Rig whose instruments deliver from threads of their own, as drivers do: they push, the mapper
/// takes with next(). No driver ever waits for the mapper: when it is late, the oldest posed frame
/// is lost (kOverload).
///
/// Thread safety: from any thread all but what FrameSource declares; that from the mapper's.
/// Memory: that of the Rig, `queue.capacity` frames, and 100 events that nobody has taken.
class LiveRig final : public FrameSource, public LiveSink {
 public:
  /// The rig, and how long it waits.
  struct Options {
    RigOptions rig;     ///< cameras, mounts and gates
    QueuePolicy queue;  ///< its speed does not matter here
    /// Silence of the cameras after which next() gives up: time to plug a cable in again.
    Nanoseconds timeout = std::chrono::seconds(10);
  };
  /// Nothing is connected yet.
  LiveRig(SourceInfo info, const Options& options);

  /// From the tracker's thread.
  void push(const PoseSample& pose) override;
  /// From a camera's thread.
  void push(DepthFrame depth) override;
  /// From the thread that looks after the devices.
  void note(RigEvent event) override;
  /// The tracker has been started again.
  void start_poses_anew() override;
  /// When the camera last delivered; nullopt: never.
  [[nodiscard]] std::optional<HostTime> last_image(std::size_t camera) const override;
  /// When the tracker last delivered; nullopt: never.
  [[nodiscard]] std::optional<HostTime> last_pose() const override;
  /// No instrument will deliver again.
  void close();

  /// Waits for the next frame. Errors: kIo if no image has come for `timeout`.
  [[nodiscard]] Expected<std::optional<Frame>> next() override;
  /// What is known before the first frame.
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  /// What was lost so far.
  [[nodiscard]] const FrameTally& tally() const override { return tally_; }
  [[nodiscard]] const RigStatistics* statistics() const override { return &facts_; }
  /// Cameras, mounts and gates.
  [[nodiscard]] const RigOptions* rig() const override { return &options_.rig; }
  void stop_when(const std::function<bool()>& is_unwanted) override { is_unwanted_ = is_unwanted; }
  [[nodiscard]] std::vector<RigEvent> take_events() override;

 private:
  // REQUIRES: the lock.
  void push_believed_poses();
  void push_believed_images(std::size_t camera);
  void collect();
  void take_stock();

  const SourceInfo info_;
  const Options options_;
  FrameTally tally_;  // the mapper's, as are the next three
  RigStatistics facts_;
  std::size_t delivered_ = 0;
  std::function<bool()> is_unwanted_;

  mutable std::mutex mutex_;  // of all that follows
  std::condition_variable changed_;
  Rig rig_;
  RigGates gates_;
  std::size_t pose_clocks_ = 0;            // times that the rig was told of a clock set back
  std::vector<std::size_t> image_clocks_;  // likewise, by camera
  std::deque<Frame> queue_;
  RigEventList events_;
  RigEventCounts event_counts_{};
  std::vector<std::optional<HostTime>> last_images_;
  std::optional<HostTime> last_pose_;
  std::size_t overloaded_ = 0;
  std::size_t images_ = 0;
  bool is_closed_ = false;
};

}  // namespace swiftlet
