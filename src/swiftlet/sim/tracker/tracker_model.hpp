// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <random>

#include "swiftlet/base/time.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet::sim {

/// One sample of a T265, as the device gives it: pose of the device in its own world, both with x
/// right, y up, z backward; the world's origin and heading are those of the device at its start.
struct RawTrackerPose {
  Stamp stamp;
  Eigen::Quaterniond R_raw;
  Eigen::Vector3d t_raw_m;
  std::uint8_t confidence;  ///< 1 low, 2 medium, 3 high
};

/// By how much a tracker is wrong at the moment, its noise left out. [scene]
struct TrackerDrift {
  Eigen::Vector3d offset_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
};

/// A tracking camera (T265) on a body, wherever that goes: truth, plus a slow drift, plus white
/// noise. Repeatable: same options, seed, start and poses, same samples. Time 0 of its stamps is
/// its start.
class TrackerModel {
 public:
  TrackerModel(const TrackerOptions& options, std::uint64_t seed,
               const Transform<World, Body>& start);

  /// When the next sample is due.
  [[nodiscard]] Stamp next_stamp() const;
  /// That sample, of a body that truly is there at that time.
  [[nodiscard]] RawTrackerPose sample(const Transform<World, Body>& T_scene_body);

  /// Where the tracker's world lies in the scene: the level frame at the body's position at the
  /// start, with its heading. Only a simulation knows it.
  [[nodiscard]] const Transform<World, World>& T_scene_tracker() const { return T_scene_tracker_; }
  [[nodiscard]] TrackerDrift drift() const;

 private:
  void wander(double dt_s);
  [[nodiscard]] std::uint8_t confidence(double t_s) const;
  [[nodiscard]] Eigen::Vector3d noise(double sigma);

  TrackerOptions options_;
  Transform<World, World> T_scene_tracker_;
  std::mt19937_64 random_;
  std::normal_distribution<double> gaussian_;
  std::int64_t samples_ = 0;
  Eigen::Vector3d drift_m_ = Eigen::Vector3d::Zero();  // in the tracker's world
  double yaw_drift_rad_ = 0.0;
  bool has_jumped_ = false;
};

}  // namespace swiftlet::sim
