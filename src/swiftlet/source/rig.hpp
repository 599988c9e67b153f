// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/frame/pose_track.hpp"
#include "swiftlet/source/frame_source.hpp"

namespace swiftlet {

/// One reading of a tracking camera or other pose source, already in our axes.
struct PoseSample {
  Stamp stamp;
  Eigen::Quaterniond R_world_body;
  Eigen::Vector3d t_world_body_m;
  std::uint8_t confidence = 3;  ///< T265 scale: 0 failed, 1 low, 2 medium, 3 high
};

/// Joins a stream of depth images with a stream of poses into posed frames: the one path that
/// simulated, recorded and live rigs share. Depth images wait until a pose at or after their time
/// has come, then get the pose interpolated at their own time and the rigid mount of the camera.
///
/// Memory: PoseTrack's capacity and at most `max_waiting` depth images; the oldest waiting one is
/// lost (counted).
class Rig {
 public:
  struct Options {
    Transform<Body, Camera> T_body_camera{};  ///< the mount (extrinsics)
    PoseTrack::Options track{};
    std::uint8_t min_confidence = 1;  ///< poses below are refused
    std::size_t max_waiting = 8;      ///< depth images that may wait for their pose
  };

  explicit Rig(const Options& options);

  void push(const PoseSample& pose);
  /// Depth images come in time order; one that does not is lost (counted).
  void push(DepthFrame depth);
  /// No more poses will come: what still waits is decided now.
  void finish() { is_finished_ = true; }

  /// The oldest depth image whose pose is known by now; nullopt if none is ready.
  [[nodiscard]] std::optional<Frame> pop();

  [[nodiscard]] const FrameTally& tally() const { return tally_; }

 private:
  Options options_;
  PoseTrack track_;
  std::deque<DepthFrame> waiting_;  // ascending stamps, all different
  std::optional<Stamp> last_depth_stamp_;
  FrameTally tally_;
  bool is_finished_ = false;
};

}  // namespace swiftlet
