// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <optional>

#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/plan/plan_options.hpp"
#include "swiftlet/sim/vehicle/true_clearance.hpp"

namespace swiftlet {

/// What share of the places that a ball could truly get to from `start_m` the map knows to be free:
/// places 0.2 m apart, within the window and the bounds, from one to the next by their faces.
/// `truth` is of the point, see TrueClearance::distance_m(). Cost: microseconds a place; a second
/// for a window of 20 x 20 x 6 m.
[[nodiscard]] double explored_share(const sim::TrueClearance& truth, const RollingMap& map,
                                    const OccupancyThresholds& thresholds,
                                    const Eigen::Vector3d& start_m, double radius_m,
                                    const std::optional<SpaceBox>& bounds);

}  // namespace swiftlet
