// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>

#include "swiftlet/source/frame_source.hpp"
#include "swiftlet/source/real_time_source.hpp"
#include "swiftlet/source/rig.hpp"

namespace swiftlet {

/// A Rig whose instruments deliver from threads of their own, as drivers do: they push, the mapper
/// takes with next(). No driver ever waits for the mapper: when it is late, the oldest posed frame
/// is lost (kOverload).
///
/// Thread safety: all but next() and tally() from any thread; these from the mapper's.
/// Memory: that of the Rig and `queue.capacity` frames.
class LiveRig final : public FrameSource {
 public:
  struct Options {
    RigOptions rig;
    QueuePolicy queue;  ///< its speed does not matter here
    /// Silence of the cameras after which next() gives up: time to plug a cable in again.
    Nanoseconds patience = std::chrono::seconds(10);
  };
  LiveRig(SourceInfo info, const Options& options);

  void push(const PoseSample& pose);
  void push(DepthFrame depth);
  /// See Rig::start_poses_anew().
  void start_poses_anew();
  /// No instrument will deliver again.
  void close();

  /// Waits for the next frame. Errors: kIo if no image has come for `patience`.
  [[nodiscard]] Expected<std::optional<Frame>> next() override;
  [[nodiscard]] const SourceInfo& info() const override { return info_; }
  [[nodiscard]] const FrameTally& tally() const override { return tally_; }

 private:
  void collect();  // REQUIRES: the lock

  const SourceInfo info_;
  const Options options_;
  FrameTally tally_;  // the mapper's
  std::size_t delivered_ = 0;

  std::mutex mutex_;  // of all that follows
  std::condition_variable changed_;
  Rig rig_;
  std::deque<Frame> queue_;
  std::size_t overloaded_ = 0;
  std::size_t images_ = 0;
  bool is_closed_ = false;
};

}  // namespace swiftlet
