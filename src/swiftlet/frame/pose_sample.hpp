// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// One reading of a tracking camera or other pose source, already in our axes. Nothing in it is
/// trusted.
struct PoseSample {
  Stamp stamp;
  Eigen::Quaterniond R_world_body;
  Eigen::Vector3d t_world_body_m;
  std::uint8_t confidence = 3;  ///< T265 scale: 0 failed, 1 low, 2 medium, 3 high
  ClockDomain clock = ClockDomain::kUnspecified;
};

}  // namespace swiftlet
