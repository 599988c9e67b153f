// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>

#include "swiftlet/eval/score/score_job.hpp"
#include "swiftlet/eval/thesis/experiment_map.hpp"

namespace swiftlet::eval {

Expected<ExperimentResult> run_apartment(const ProgressFunction& progress);

namespace {

/// A score of the map by the default model and of that by the thesis's; as bad as can be if it has
/// none.
struct Both {
  double ours, thesis;
};

Both scores_of(const ScoreReport& report, std::string_view name, double worst) {
  const auto row =
      std::ranges::find_if(report.rows, [&](const ScoreRow& r) { return r.meaning.name == name; });
  if (row == report.rows.end()) return {worst, worst};
  return {row->values[0].value_or(worst), row->values[1].value_or(worst)};
}

}  // namespace

/// The flight of the demo, three images a second, in voxels of 0.1 m, judged by the scene. The
/// default model is held to what the thesis expects; what its own reaches stands beside it.
Expected<ExperimentResult> run_apartment(const ProgressFunction& progress) {
  constexpr const char* kFlight = "sim:apartment?rate=3";
  ScoreJob job;
  job.source = kFlight;
  job.progress = progress;
  job.maps = {job.config.integrate.model, std::string(kThesisModel)};
  job.config.map.voxel_m = 0.1;
  const auto report = score_flight(job);
  if (!report) return tl::make_unexpected(report.error());
  const auto mapper = map_of(kFlight, job.config, job.frames, progress);
  if (!mapper) return tl::make_unexpected(mapper.error());
  ExperimentResult result;
  result.figures = {layer_figure(*mapper, {{-4, -4, 13}, {104, 84, 13}}, "apartment",
                                 "The flat at camera height, 1.3 m")};
  const Both recall = scores_of(*report, "occupied recall, within 1 voxel", 0.0);
  const Both corners = scores_of(*report, "corner angles off, mean", 90.0);
  const Both straight = scores_of(*report, "wall columns within half a voxel of their line", 0.0);
  result.checks = {
      {"the map matches the floor plan", "98 % of the seen surface within a voxel",
       fmt::format("{:.2f} % (thesis's model: {:.2f} %)", 100.0 * recall.ours,
                   100.0 * recall.thesis),
       recall.ours >= 0.98},
      {"corners", "90 deg, to 1 deg on average",
       fmt::format("off by {:.2f} deg on average (thesis's model: {:.2f} deg)", corners.ours,
                   corners.thesis),
       corners.ours <= 1.0},
      {"walls straight and solid", "80 % of their columns within half a voxel of a line",
       fmt::format("{:.1f} % (thesis's model: {:.1f} %)", 100.0 * straight.ours,
                   100.0 * straight.thesis),
       straight.ours >= 0.8}};
  return result;
}

}  // namespace swiftlet::eval
