// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string_view>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/fly/fly.hpp"
#include "swiftlet/plan/plan_options.hpp"

namespace swiftlet {

/// A scene and what may be done in it.
struct FlightTask {
  sim::Scene scene;
  FlightStart start;  ///< of random scenes their task's, else where the flight of the scene begins
  std::optional<Eigen::Vector3d> goal_m{};
  std::optional<SpaceBox> bounds{};  ///< of random scenes
};

/// Reads an address: `sim:apartment`, or without `sim:`, as in `random:forest?seed=7`. Errors:
/// those of read_sim_flight(); kUsage for options that a flight does not heed.
[[nodiscard]] Expected<FlightTask> read_flight_task(std::string_view address);

}  // namespace swiftlet
