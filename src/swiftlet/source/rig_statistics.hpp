// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/frame/pose_sample.hpp"

namespace swiftlet {

/// What has come from one instrument, whether it was used or not.
struct StreamStatistics {
  std::size_t samples = 0;
  std::optional<Stamp> first, last;  ///< the earliest and the latest
  Nanoseconds longest_gap{0};        ///< between neighbours in order, up to an hour
  std::size_t backward = 0;          ///< samples whose time is not after that of the one before
  std::array<std::size_t, kClockDomainNames.size()> clocks{};  ///< samples by ClockDomain

  void note(Stamp stamp, ClockDomain clock);
  /// Samples a second, without the time that a set clock skips; 0 for fewer than two.
  [[nodiscard]] double rate_hz() const;
  [[nodiscard]] Nanoseconds duration() const { return first ? *last - *first : Nanoseconds(0); }

 private:
  std::optional<Stamp> previous_;
  Nanoseconds passed_{0};  // between neighbours, but where the clock was set
};

struct CameraStatistics : StreamStatistics {
  std::optional<PinholeIntrinsics> intrinsics{};  ///< of the newest image
  float unit_m = 0.0F;                            ///< of its raw depth
  std::size_t intrinsics_changes = 0;             ///< times they were others than before
  std::optional<Stamp> intrinsics_changed{};      ///< the first time

  void note(const DepthFrame& depth);
};

struct PoseFacts : StreamStatistics {
  std::array<std::size_t, 4> confidence{};  ///< samples by confidence, 0 failed .. 3 high
  std::size_t broken = 0;                   ///< not finite, or no unit quaternion
  Eigen::Vector3d low_m{0, 0, 0};           ///< corners of where the body has been [world]
  Eigen::Vector3d high_m{0, 0, 0};
  std::optional<double> least_tilt_rad{};  ///< of the body's z axis from the world's

  void note(const PoseSample& pose);
};

/// What a rig has received so far: what `swiftlet doctor` judges. Cost: a few comparisons a sample.
struct RigStatistics {
  std::vector<CameraStatistics> cameras{};  ///< by camera of the rig
  PoseFacts poses{};
};

}  // namespace swiftlet
