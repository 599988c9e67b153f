// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>

#include "swiftlet/app/experiment_map.hpp"
#include "swiftlet/app/score_job.hpp"

namespace swiftlet::app {

Expected<ExperimentResult> run_apartment();

namespace {

std::optional<double> value_of(const ScoreReport& report, std::string_view name) {
  const auto row =
      std::ranges::find_if(report.rows, [&](const ScoreRow& r) { return r.meaning.name == name; });
  if (row == report.rows.end()) return std::nullopt;
  return row->values.front();
}

}  // namespace

/// The flight of the demo, three images a second, in cells of 0.1 m, judged by the scene.
Expected<ExperimentResult> run_apartment() {
  constexpr const char* kFlight = "sim:apartment?rate=3";
  ScoreJob job;
  job.source = kFlight;
  job.maps.emplace_back("projective");
  job.config.map.voxel_m = 0.1;
  const auto report = score_flight(job);
  if (!report) return tl::make_unexpected(report.error());
  const auto mapper = map_of(kFlight, job.config, job.frames);
  if (!mapper) return tl::make_unexpected(mapper.error());
  ExperimentResult result;
  result.figures = {layer_figure(*mapper, {{-4, -4, 13}, {104, 84, 13}}, "apartment",
                                 "The flat at camera height, 1.3 m")};
  const double recall = value_of(*report, "occupied recall, within 1 cell").value_or(0.0);
  result.checks = {{"the map matches the floor plan", "98 % of the seen surface within a cell",
                    fmt::format("{:.2f} %", 100.0 * recall), recall >= 0.98}};
  const double corners = value_of(*report, "corner angles off, mean").value_or(90.0);
  const double straight =
      value_of(*report, "wall columns within half a cell of their line").value_or(0.0);
  result.checks.push_back({"corners", "90 deg, to 1 deg on average",
                           fmt::format("off by {:.2f} deg on average", corners), corners <= 1.0});
  result.checks.push_back({"walls straight and solid",
                           "80 % of their columns within half a cell of a line",
                           fmt::format("{:.1f} %", 100.0 * straight), straight >= 0.8});
  return result;
}

}  // namespace swiftlet::app
