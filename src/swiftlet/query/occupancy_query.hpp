// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>

#include "swiftlet/map/occupancy_map.hpp"

namespace swiftlet {

/// Is this point [m, world] free, occupied or unknown? Unknown outside the map. With thresholds of
/// the caller's, or those of the map. Cost: one look-up.
template <OccupancyMap Map>
[[nodiscard]] Occupancy occupancy_at(const Map& map, const Eigen::Vector3d& p_world,
                                     const OccupancyThresholds& thresholds) {
  return thresholds.classify(map.log_odds(p_world));
}
/// By the map's own thresholds.
template <OccupancyMap Map>
[[nodiscard]] Occupancy occupancy_at(const Map& map, const Eigen::Vector3d& p_world) {
  return map.occupancy(p_world);
}

}  // namespace swiftlet
