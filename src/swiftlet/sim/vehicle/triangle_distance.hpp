// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>

#include "swiftlet/sim/ray_caster.hpp"

namespace swiftlet::sim {

using Triangle3d = std::array<Eigen::Vector3d, 3>;
using Segment3d = std::array<Eigen::Vector3d, 2>;

/// A triangle of the scene, for distances that floats would round.
[[nodiscard]] inline Triangle3d in_double(const Triangle& t) {
  return {t[0].cast<double>(), t[1].cast<double>(), t[2].cast<double>()};
}

/// Distances [m] between what is closed and may be degenerate (a triangle that is a line or a
/// point, a segment of length 0). 0 where the two touch or cross.
/// Source: Ericson, Real-Time Collision Detection (2005), 5.1.
[[nodiscard]] double distance(const Eigen::Vector3d& point, const Triangle3d& triangle);
[[nodiscard]] double distance(const Segment3d& a, const Segment3d& b);
[[nodiscard]] double distance(const Segment3d& segment, const Triangle3d& triangle);
[[nodiscard]] double distance(const Triangle3d& a, const Triangle3d& b);

}  // namespace swiftlet::sim
