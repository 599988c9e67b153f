// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/fly/flight_series.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "swiftlet/fly/flight_task.hpp"

namespace swiftlet {
namespace {

Expected<FlightReport> fly_one(const std::string& scene, const std::string& map_name,
                               const SeriesOptions& options) {
  auto task = read_flight_task(scene);
  if (!task) return forward_error(std::move(task));
  FlyOptions how;
  how.goal_m = task->goal_m;
  how.bounds = task->bounds;
  how.seed = task->scene.seed;
  how.max_speed_mps = options.max_speed_mps;
  how.is_unwanted = options.is_unwanted;
  how.counts_measured_time = map_name == "octomap";
  auto map = make_flown_map(map_name, how.mapper);
  if (!map) return forward_error(std::move(map));
  return fly(task->scene, task->start, how, std::move(*map));
}

void add(SeriesRow& row, const FlightReport& report) {
  row.least_clearance_m = row.flights == 0
                              ? report.least_clearance_m
                              : std::min(row.least_clearance_m, report.least_clearance_m);
  ++row.flights;
  row.waiting_share += report.waiting_share;
  row.deadline_misses += report.deadline_misses;
  row.frames += report.frames;
  row.frames_dropped += report.frames_dropped;
  row.collided += report.end == FlightEnd::kCollided ? 1 : 0;
  if (!report.is_success()) return;
  ++row.arrived;
  row.mean_time_s += report.time_s;
  row.mean_speed_mps += report.mean_speed_mps;
}

}  // namespace

Expected<std::vector<SeriesFlight>> fly_series(const SeriesOptions& options,
                                               const TellFlight& tell) {
  std::vector<SeriesFlight> flown;
  for (const std::string& kind : options.kinds) {
    for (std::size_t i = 0; i < options.flights; ++i) {
      const std::string scene = fmt::format("random:{}?seed={}", kind, options.first_seed + i);
      for (const std::string& map : options.maps) {
        auto report = fly_one(scene, map, options);
        if (!report) return forward_error(std::move(report));
        flown.push_back({scene, kind, map, std::move(*report)});
        tell(flown.back());
        if (options.is_unwanted && options.is_unwanted()) return flown;
      }
    }
  }
  return flown;
}

std::vector<SeriesRow> sum_up(const std::vector<SeriesFlight>& flights) {
  std::vector<SeriesRow> rows;
  for (const SeriesFlight& flight : flights) {
    auto row = std::ranges::find_if(rows, [&](const SeriesRow& known) {
      return known.kind == flight.kind && known.map == flight.map;
    });
    if (row == rows.end()) {
      rows.push_back({flight.kind, flight.map});
      row = rows.end() - 1;
    }
    add(*row, flight.report);
  }
  for (SeriesRow& row : rows) {
    row.waiting_share /= static_cast<double>(row.flights);
    if (row.arrived == 0) continue;
    row.mean_time_s /= static_cast<double>(row.arrived);
    row.mean_speed_mps /= static_cast<double>(row.arrived);
  }
  return rows;
}

}  // namespace swiftlet
