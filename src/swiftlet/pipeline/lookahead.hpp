// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet {

/// How the window goes with the vehicle's speed.
struct WindowOptions {
  double lookahead_s = 0.0;  ///< the middle of the window is where the vehicle will be by then
};

/// Where the middle of the window should be: ahead of a fast vehicle, which sees what it needs room
/// for, and at the vehicle when it is slow (thesis 5.1). The same memory shows half as much again
/// ahead.
///
/// The velocity is the median, axis by axis, of the last steps from frame to frame of each camera:
/// a step that a tracker's jump makes up is out of the middle. It counts as 0 after a gap, when
/// time goes back and when the world begins anew. The middle is at most a quarter of the window
/// ahead, and never so far that the vehicle could leave the window before the trigger box moves it.
/// Real time: allocates nothing.
class Lookahead {
 public:
  Lookahead(const WindowOptions& window, const RollingMap::Options& map);

  /// For each frame that is fused, in order. [m, world]
  [[nodiscard]] Eigen::Vector3d middle_for(const Frame& frame);
  [[nodiscard]] Eigen::Vector3d velocity_mps() const;

 private:
  static constexpr std::size_t kSteps = 7;

  struct Place {
    Stamp stamp;
    Eigen::Vector3d p_world;
  };
  void forget();

  double lookahead_s_;
  Eigen::Vector3d farthest_m_;
  std::array<std::optional<Place>, 256> last_{};  // by camera
  std::array<Eigen::Vector3d, kSteps> steps_mps_{};
  std::size_t step_count_ = 0;  // the newest are at step_count_ - 1, ... modulo kSteps
  std::uint32_t pose_epoch_ = 0;
};

}  // namespace swiftlet
