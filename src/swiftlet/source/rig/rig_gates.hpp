// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <vector>

#include "swiftlet/source/rig/rig.hpp"
#include "swiftlet/source/rig/stamp_gate.hpp"

namespace swiftlet {

/// The gates that all samples of a rig pass before they reach it, recorded or live.
struct RigGates {
  explicit RigGates(std::size_t camera_count) : cameras(camera_count) {}

  std::vector<StampGate<DepthFrame>> cameras;
  StampGate<PoseSample> poses;

  /// Tells the rig what they have refused and seen so far.
  void report_to(Rig& rig) const {
    StampTally tally;
    tally.poses_refused = poses.refused();
    tally.pose_clock = poses.steps();
    for (const auto& camera : cameras) {
      tally.images_refused += camera.refused();
      if (camera.steps().back > tally.image_clock.back) tally.image_clock = camera.steps();
      tally.image_clock.ahead = std::max(tally.image_clock.ahead, camera.steps().ahead);
      tally.image_clock.last_ahead =
          std::max(tally.image_clock.last_ahead, camera.steps().last_ahead);
    }
    rig.note_stamps(tally);
  }
};

}  // namespace swiftlet
