// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/tracker/tracker.hpp"

namespace swiftlet::sim {

Tracker::Tracker(const TrackerOptions& options, std::uint64_t seed, const Flight& flight,
                 const Transform<Body, Camera>& T_body_camera, Nanoseconds starts_at)
    : flight_(flight),
      T_camera_body_(T_body_camera.inverse()),
      starts_at_(starts_at),
      model_(options, seed, true_pose(Stamp{0})) {}

Transform<World, Body> Tracker::true_pose(Stamp stamp) const {
  return flight_.camera_at(starts_at_ + Nanoseconds(stamp.ns)) * T_camera_body_;
}

}  // namespace swiftlet::sim
