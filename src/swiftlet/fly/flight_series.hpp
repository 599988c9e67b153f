// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/fly/flight_report.hpp"

namespace swiftlet {

/// Many flights: of each kind of random scene so many, on each map.
struct SeriesOptions {
  std::vector<std::string> kinds{"forest", "warehouse", "office", "cave", "maze"};
  std::vector<std::string> maps{"swiftlet", "octomap"};
  std::size_t flights = 5;  ///< of each kind and map, with the seeds from first_seed on
  std::uint64_t first_seed = 1;
  double max_speed_mps = 2.0;
  std::function<bool()> is_unwanted{};  ///< as in FlyOptions
};

struct SeriesFlight {
  std::string scene;  ///< as fly takes it: "random:forest?seed=7"
  std::string kind;
  std::string map;
  FlightReport report;
};

/// Called after each flight.
using TellFlight = std::function<void(const SeriesFlight& flight)>;

/// Flies them all, each to its scene's goal. OctoMap's map flies at its own pace: the time that it
/// takes on this machine is its latency, and frames that come meanwhile are lost. Errors: those of
/// fly() and of scenes; an unknown map or kind.
[[nodiscard]] Expected<std::vector<SeriesFlight>> fly_series(const SeriesOptions& options,
                                                             const TellFlight& tell);

/// The flights of one kind on one map, summed up.
struct SeriesRow {
  std::string kind, map;
  std::size_t flights = 0, arrived = 0, collided = 0;
  double mean_time_s = 0.0;        ///< of those that arrived
  double mean_speed_mps = 0.0;     ///< likewise
  double least_clearance_m = 0.0;  ///< of all
  double waiting_share = 0.0;      ///< mean
  std::size_t deadline_misses = 0, frames = 0, frames_dropped = 0;
};
[[nodiscard]] std::vector<SeriesRow> sum_up(const std::vector<SeriesFlight>& flights);

}  // namespace swiftlet
