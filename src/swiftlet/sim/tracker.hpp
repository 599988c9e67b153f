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

/// A tracking camera (T265) on the body: truth, plus a slow drift, plus white noise.
/// Repeatable: same scene, seed and start, same samples. Time 0 of its stamps is its start.
class Tracker {
 public:
  /// `T_body_camera` ties the flight, which is the camera's, to the body that is tracked.
  Tracker(const TrackerOptions& options, std::uint64_t seed, const Flight& flight,
          const Transform<Body, Camera>& T_body_camera, Nanoseconds starts_at);

  /// The next sample, 1 / rate after the last.
  [[nodiscard]] RawTrackerPose next();
  [[nodiscard]] Stamp next_stamp() const;

  /// Where the tracker's world lies in the scene: the level frame at the body's position at the
  /// start, with its heading. Only a simulation knows it.
  [[nodiscard]] const Transform<World, World>& T_scene_tracker() const { return T_scene_tracker_; }
  [[nodiscard]] Transform<World, Body> true_pose(Stamp stamp) const;

 private:
  void drift(double dt_s);
  [[nodiscard]] std::uint8_t confidence(double t_s) const;
  [[nodiscard]] Eigen::Vector3d noise(double sigma);

  TrackerOptions options_;
  Flight flight_;
  Transform<Camera, Body> T_camera_body_;
  Nanoseconds starts_at_;
  Transform<World, World> T_scene_tracker_;
  std::mt19937_64 random_;
  std::normal_distribution<double> gaussian_;
  std::int64_t samples_ = 0;
  Eigen::Vector3d drift_m_ = Eigen::Vector3d::Zero();
  double yaw_drift_rad_ = 0.0;
  bool has_jumped_ = false;
};

}  // namespace swiftlet::sim
