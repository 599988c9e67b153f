// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>

#include "swiftlet/base/time.hpp"
#include "swiftlet/sim/scene.hpp"
#include "swiftlet/sim/tracker/tracker_model.hpp"

namespace swiftlet::sim {

/// A tracking camera (T265) on a body that follows a flight.
/// Repeatable: same scene, seed and start, same samples. Time 0 of its stamps is its start.
class Tracker {
 public:
  /// `T_body_camera` ties the flight, which is the camera's, to the body that is tracked.
  Tracker(const TrackerOptions& options, std::uint64_t seed, const Flight& flight,
          const Transform<Body, Camera>& T_body_camera, Nanoseconds starts_at);

  /// The next sample, 1 / rate after the last.
  [[nodiscard]] RawTrackerPose next() { return model_.sample(true_pose(next_stamp())); }
  [[nodiscard]] Stamp next_stamp() const { return model_.next_stamp(); }

  [[nodiscard]] const Transform<World, World>& T_scene_tracker() const {
    return model_.T_scene_tracker();
  }
  [[nodiscard]] Transform<World, Body> true_pose(Stamp stamp) const;

 private:
  Flight flight_;
  Transform<Camera, Body> T_camera_body_;
  Nanoseconds starts_at_;
  TrackerModel model_;
};

}  // namespace swiftlet::sim
