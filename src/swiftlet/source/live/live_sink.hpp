// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <optional>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/frame/pose_sample.hpp"
#include "swiftlet/source/rig_event.hpp"

namespace swiftlet {

/// Where live instruments deliver to. Thread safety: all from any thread; none waits for a reader.
class LiveSink {
 public:
  virtual ~LiveSink() = default;
  virtual void push(const PoseSample& pose) = 0;
  virtual void push(DepthFrame depth) = 0;
  virtual void note(RigEvent event) = 0;
  /// The pose source was switched off and on: see Rig::start_poses_anew().
  virtual void start_poses_anew() = 0;

  /// When the last image of a camera, or the last pose, has come; nullopt before the first.
  /// REQUIRES: the rig has that camera.
  [[nodiscard]] virtual std::optional<HostTime> last_image(std::size_t camera) const = 0;
  [[nodiscard]] virtual std::optional<HostTime> last_pose() const = 0;
};

}  // namespace swiftlet
