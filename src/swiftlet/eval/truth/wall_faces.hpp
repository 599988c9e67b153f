// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <vector>

#include "swiftlet/sim/scene.hpp"

namespace swiftlet::eval {

/// An upright rectangle that a map should show as a straight wall [m, world].
struct WallFace {
  Eigen::Vector3d corner_m;  ///< lower end of the rectangle, where `along` starts
  Eigen::Vector3d along;     ///< unit, horizontal
  Eigen::Vector3d normal;    ///< unit, horizontal, out of the wall: up x along
  double length_m;
  double height_m;
};

/// The upright faces, at least `least_m` long and high, of the boxes that stand upright.
[[nodiscard]] std::vector<WallFace> wall_faces(const std::vector<sim::Object>& objects,
                                               double least_m = 1.5);

}  // namespace swiftlet::eval
