// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "swiftlet/query/sweep/sweep.hpp"

namespace swiftlet {

/// A way on which the body is clear, as sweep() has it.
struct PlannedPath {
  /// From the start to the goal, both included; straight between them. The axes of the body stay
  /// those of the world. [m, world]
  std::vector<Eigen::Vector3d> points;
  double length_m = 0.0;
  SweepClearance tightest{};      ///< looked for as far as the comfort and the margin
  std::uint64_t frame_count = 0;  ///< of the map that it was planned on
};

/// Length of a polyline [m].
[[nodiscard]] inline double length_of(const std::vector<Eigen::Vector3d>& points) {
  double length_m = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) length_m += (points[i] - points[i - 1]).norm();
  return length_m;
}

}  // namespace swiftlet
