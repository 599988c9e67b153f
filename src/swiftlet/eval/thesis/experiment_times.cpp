// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "swiftlet/eval/bench/bench_tables.hpp"
#include "swiftlet/eval/thesis/experiment.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::eval {

Expected<ExperimentResult> run_times(const ProgressFunction& progress);

/// Tables 4.2 and 4.3, each line with the thesis's time beside ours: 40 frames of the flat.
Expected<ExperimentResult> run_times(const ProgressFunction& progress) {
  auto source = open_source("sim:apartment?rate=1");
  if (!source) return forward_error(std::move(source));
  const auto workload = read_workload(
      **source, {.frames = 40, .warm_up = 10, .max_range_m = {}, .progress = progress});
  if (!workload) return tl::make_unexpected(workload.error());
  const auto tables = measure_thesis_tables(*workload, MapperConfig{}, progress);
  if (!tables) return tl::make_unexpected(tables.error());
  ExperimentResult result;
  Figure figure{"times", "Milliseconds a frame: lines of tables 4.2 and 4.3 in order", "line",
                "ms (log10)"};
  Curve thesis{"thesis, i7-8550U", {}, true}, ours{"here", {}, true};
  const auto add = [&](const std::vector<ThesisLine>& lines) {
    for (const ThesisLine& line : lines) {
      const double best =
          line.projective_ms > 0.0 ? std::min(line.rays_ms, line.projective_ms) : line.rays_ms;
      const auto number = static_cast<double>(thesis.points.size() + 1);
      thesis.points.emplace_back(number, std::log10(line.thesis_ms));
      ours.points.emplace_back(number, std::log10(best));
      result.checks.push_back({line.what, fmt::format("{:.2f} ms or less", line.thesis_ms),
                               fmt::format("{:.2f} ms", best), best <= line.thesis_ms});
    }
  };
  add(tables->functions);
  add(tables->mapping);
  figure.curves = {std::move(thesis), std::move(ours)};
  result.figures = {std::move(figure)};
  return result;
}

}  // namespace swiftlet::eval
