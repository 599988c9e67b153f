// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <memory>
#include <vector>

#include "swiftlet/app/view/mavlink_flags.hpp"
#include "swiftlet/session/session_observer.hpp"
#include "swiftlet/source/frame_source.hpp"

namespace swiftlet::app {

/// Tells an autopilot of a flight while it goes on, and gives its poses to a source that wants
/// them. The mapping thread hands over a pose a frame and never waits.
class AutopilotWatch final : public SessionObserver {
 public:
  /// `source` must outlive it. Errors: those of autopilot_options() and Autopilot::start(); kUsage
  /// if poses would go round in a circle.
  [[nodiscard]] static Expected<std::unique_ptr<AutopilotWatch>> start(const MavlinkFlags& flags,
                                                                       const MapperConfig& config,
                                                                       FrameSource& source);

  void map_begun(const Mapper& mapper) override;
  void frame_done(const Frame& frame, const MapUpdate& update, const Mapper& mapper) override;
  void block_left(const BlockIndex&, const VoxelBlock&, std::uint64_t) override {}

  /// What has happened to instruments: the pilot reads of those that are gone.
  void tell_pilot(const std::vector<RigEvent>& events);
  /// What has happened to links and vehicle since the last call, a sentence each.
  [[nodiscard]] std::vector<std::string> take_notes() { return autopilot_->take_notes(); }
  /// Falls silent: an autopilot must not fly by a map that no longer grows. There will be no more
  /// frames, and nothing else may be asked.
  void finish() { autopilot_.reset(); }

 private:
  explicit AutopilotWatch(FrameSource& source);

  std::vector<Transform<Body, Camera>> mounts_;  // by camera
  std::unique_ptr<mavlink::PoseTaker> relay_;    // null: nobody wants its poses
  std::unique_ptr<mavlink::Autopilot> autopilot_;
};

}  // namespace swiftlet::app
