// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "swiftlet/mavlink/companion/flight_news.hpp"
#include "swiftlet/mavlink/wire/motion_messages.hpp"

namespace swiftlet::mavlink {

/// How the body moves, in its own axes (ours: x forward, y left, z up).
struct BodyMotion {
  Eigen::Vector3d v_body_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d w_body_radps = Eigen::Vector3d::Zero();
};
/// The mean motion from one frame to the next. REQUIRES: `next` was taken later, in the same epoch.
[[nodiscard]] BodyMotion motion_between(const MappedFrame& frame, const MappedFrame& next);

/// A pose as ODOMETRY, LOCAL_FRD / BODY_FRD, the one form that PX4 and ArduPilot both take; all
/// numbers finite, as ArduPilot hands the speed to its filter unseen. Variances and quality follow
/// the confidence of the tracker: 0.01 m^2 (and rad^2) for high, ten times as much for each step
/// below, and ten times that for the motion; 100, 66, 33 % and failed.
/// Source of these: vision_to_mavros, t265_to_mavlink.py.
[[nodiscard]] Odometry odometry_of(const MappedFrame& frame, const BodyMotion& motion,
                                   std::uint64_t time_usec, std::uint8_t reset_counter);
/// The pose as VISION_POSITION_ESTIMATE, for autopilots that know no ODOMETRY.
[[nodiscard]] VisionPositionEstimate vision_position_of(const MappedFrame& frame,
                                                        std::uint64_t time_usec,
                                                        std::uint8_t reset_counter);

}  // namespace swiftlet::mavlink
