// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/base/expected.hpp"
#include "swiftlet/fly/flight_report.hpp"
#include "swiftlet/fly/flown_map.hpp"
#include "swiftlet/fly/fly_options.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet {

/// Where a flight begins. [scene]
struct FlightStart {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double yaw_rad = 0.0;
};

/// Flies the simulated rig through a scene on nothing but the map that it makes on the way: depth
/// images and poses with their faults, map, distance field, frontier, OMPL's paths, a vehicle with
/// limits of acceleration and jerk that obeys late. The vehicle first turns once in place.
///
/// Clock: simulated. What the instruments, the map and the planner take is counted at fixed
/// latencies, so that a flight repeats to the bit on any machine; what they took on this one is in
/// the report beside it.
/// Safe by construction as far as the map is: every path lies in voxels known to be free, with a
/// margin, and the speed allows for a stop at its end; each new frame is asked whether the rest of
/// the path is still clear.
/// Errors: those of the rig, of the map and of options that cannot be used; a flight that fails is
/// no error, the report tells.
[[nodiscard]] Expected<FlightReport> fly(const sim::Scene& scene, const FlightStart& start,
                                         const FlyOptions& options);
/// The same on a map of another make.
[[nodiscard]] Expected<FlightReport> fly(const sim::Scene& scene, const FlightStart& start,
                                         const FlyOptions& options, FlownMapPtr map);

}  // namespace swiftlet
