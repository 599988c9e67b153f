// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/commands/flight_experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "swiftlet/app/interrupt.hpp"
#include "swiftlet/app/report/flight_summary.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/file/text_output.hpp"

#if SWIFTLET_HAS_EMBREE
#include "swiftlet/fly/flight_series.hpp"
#endif

namespace swiftlet::app {

#if SWIFTLET_HAS_EMBREE

namespace {

void tell(const SeriesFlight& flight) {
  const FlightReport& r = flight.report;
  std::fputs(fmt::format("{:<28} {:<9} {:<11} {:6.1f} s {:6.1f} m, least clearance {:.3f} m\n",
                         flight.scene, flight.map, name_of(r.end), r.time_s, r.length_m,
                         r.least_clearance_m)
                 .c_str(),
             stderr);
}

std::string csv_of(const std::vector<SeriesFlight>& flights) {
  std::string csv = "scene,map,end,time_s,length_m,least_clearance_m,waiting_share,digest\n";
  for (const SeriesFlight& f : flights) {
    csv += fmt::format("{},{},{},{:.2f},{:.2f},{:.4f},{:.4f},{:016x}\n", f.scene, f.map,
                       name_of(f.report.end), f.report.time_s, f.report.length_m,
                       f.report.least_clearance_m, f.report.waiting_share, f.report.digest);
  }
  return csv;
}

/// Where a flight went that failed; the scene and its seed fly it again.
std::string track_name(const SeriesFlight& flight) {
  std::string name = flight.scene + "_" + flight.map + ".csv";
  std::ranges::replace_if(
      name, [](char c) { return c == ':' || c == '?' || c == '='; }, '_');
  return name;
}

Status store(const std::vector<SeriesFlight>& flights, const std::string& folder) {
  const std::filesystem::path base(folder);
  for (const SeriesFlight& flight : flights) {
    if (flight.report.is_success()) continue;
    if (auto written = write_text(base / track_name(flight), track_csv(flight.report)); !written)
      return written;
  }
  return write_text(base / "flights.csv", csv_of(flights));
}

void print_table(const std::vector<SeriesRow>& rows) {
  fmt::print("{:<11} {:<9} {:>7} {:>8} {:>9} {:>8} {:>8} {:>11} {:>9} {:>7}\n", "scene", "map",
             "flights", "arrived", "collided", "time s", "m/s", "clearance m", "waiting %", "late");
  for (const SeriesRow& r : rows) {
    fmt::print("{:<11} {:<9} {:>7} {:>8} {:>9} {:>8.1f} {:>8.2f} {:>11.3f} {:>9.1f} {:>7}\n",
               r.kind, r.map, r.flights, r.arrived, r.collided, r.mean_time_s, r.mean_speed_mps,
               r.least_clearance_m, 100.0 * r.waiting_share, r.deadline_misses);
  }
}

void print_json(const std::vector<SeriesRow>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const SeriesRow& r : rows) {
    all.push_back({{"scene", r.kind},
                   {"map", r.map},
                   {"flights", r.flights},
                   {"arrived", r.arrived},
                   {"collided", r.collided},
                   {"time_s", r.mean_time_s},
                   {"mean_speed_mps", r.mean_speed_mps},
                   {"least_clearance_m", r.least_clearance_m},
                   {"waiting_share", r.waiting_share},
                   {"deadline_misses", r.deadline_misses},
                   {"frames", r.frames},
                   {"frames_dropped", r.frames_dropped}});
  }
  fmt::print("{}\n", json_text({{"flights", all}}));
}

Faults verdict(const std::vector<SeriesRow>& rows, double speed_mps) {
  std::size_t flights = 0, arrived = 0, collided = 0;
  for (const SeriesRow& row : rows) {
    if (row.map != "swiftlet") continue;
    flights += row.flights;
    arrived += row.arrived;
    collided += row.collided;
  }
  if (flights > 0 && collided == 0 && 20 * arrived >= 19 * flights) return {};
  return {{ErrorCode::kCorruptInput, "fly",
           fmt::format("of {} flights on Swiftlet's map {} arrived and {} collided", flights,
                       arrived, collided),
           fmt::format("flights.csv names them; 'swiftlet fly SCENE --speed {}' flies one again",
                       speed_mps)}};
}

}  // namespace

Faults run_flight_experiment(const FlightExperiment& experiment) {
  if (auto made = make_folder(experiment.folder); !made) return fault_of(std::move(made));
  const InterruptGuard guard;
  SeriesOptions options;
  options.flights = experiment.flights;
  options.max_speed_mps = experiment.max_speed_mps;
  options.is_unwanted = [&] { return guard.is_interrupted(); };
  const auto flights = fly_series(options, tell);
  if (!flights) return {flights.error()};
  if (auto stored = store(*flights, experiment.folder); !stored) return fault_of(std::move(stored));
  const std::vector<SeriesRow> rows = sum_up(*flights);
  experiment.as_json ? print_json(rows) : print_table(rows);
  return verdict(rows, experiment.max_speed_mps);
}

#else

Faults run_flight_experiment(const FlightExperiment& /*experiment*/) {
  return {{ErrorCode::kUnsupported, "fly", "this build has no simulated rig",
           "install libembree-dev and configure with -DSWIFTLET_WITH_EMBREE=ON"}};
}

#endif

}  // namespace swiftlet::app
