// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <vector>

#include "swiftlet/sim/ray_caster.hpp"

namespace swiftlet::sim {

/// What a way has to keep to.
struct WayLimits {
  Eigen::AlignedBox3d bounds_m;
  double clearance_m;  ///< from every surface
};

/// A polyline from start to the goal whose every point keeps the limits: A* over a grid of 0.15 m
/// from the start, then straightened. It ends within a grid cell's diagonal of the goal. nullopt if
/// there is none on that grid. Cost: some microseconds for each place looked at; a second or
/// two at worst.
[[nodiscard]] std::optional<std::vector<Eigen::Vector3d>> clear_way(const RayCaster& world,
                                                                    const Eigen::Vector3d& start_m,
                                                                    const Eigen::Vector3d& goal_m,
                                                                    const WayLimits& limits);

}  // namespace swiftlet::sim
