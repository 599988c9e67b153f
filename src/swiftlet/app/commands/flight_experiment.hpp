// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

#include "swiftlet/app/command.hpp"

namespace swiftlet::app {

/// What `swiftlet experiment fly` is asked.
struct FlightExperiment {
  std::size_t flights = 5;  ///< of each kind of random scene, on each map
  double max_speed_mps = 2.0;
  std::string folder;  ///< for flights.csv, and the track of each flight that failed
  bool as_json = false;
};

/// Flies the same scenes on Swiftlet's map and on OctoMap's and prints what came out. A fault if a
/// flight on Swiftlet's own collided, or less than 95 % arrived.
[[nodiscard]] Faults run_flight_experiment(const FlightExperiment& experiment);

}  // namespace swiftlet::app
