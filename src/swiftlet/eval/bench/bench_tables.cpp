// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/bench/bench_tables.hpp"

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>

#include "swiftlet/eval/bench/bench_race.hpp"

namespace swiftlet::eval {
namespace {

/// The timed subjects of the tables, in the order of the race.
enum class Run : std::size_t {
  kPoints,
  kTraversal10,
  kLine10,
  kLine8,
  kLine1,
  kProjective10,
  kProjective8,
  kProjective1
};

struct Setting {
  const char* integrator;
  const char* ray_method;
  int downsample;
};
constexpr std::array kSettings{
    Setting{"rays", "voxel_traversal", 10},       Setting{"rays", "line_drawing", 10},
    Setting{"rays", "line_drawing", 8},           Setting{"rays", "line_drawing", 1},
    Setting{"projective", "voxel_traversal", 10}, Setting{"projective", "voxel_traversal", 8},
    Setting{"projective", "voxel_traversal", 1}};

Expected<std::vector<TimedSubject>> make_timed(const Workload& workload, MapperConfig config) {
  config.integrate.model = kThesisModel;
  config.map.voxel_m = kThesisTablesVoxel_m;
  config.depth.downsample = 1;
  config.integrate.threads = 1;
  std::vector<TimedSubject> timed;
  timed.push_back({.name = "points", .subject = make_points_subject(config)});
  for (const Setting& s : kSettings) {
    config.integrate.integrator = s.integrator;
    config.integrate.ray_method = s.ray_method;
    config.depth.downsample = s.downsample;
    auto subject = make_mapper_subject(config);
    if (!subject) return forward_error(std::move(subject));
    const bool is_slow = s.downsample == 1 && std::string_view(s.integrator) == "rays";
    timed.push_back({.name = s.integrator,
                     .every = is_slow ? every_nth(10, workload) : 1,
                     .subject = std::move(*subject)});
  }
  return timed;
}

}  // namespace

Expected<ThesisTables> measure_thesis_tables(const Workload& workload, MapperConfig config,
                                             const ProgressFunction& progress) {
  auto timed = make_timed(workload, std::move(config));
  if (!timed) return forward_error(std::move(timed));
  race(workload, *timed, progress);
  const auto latency = [&](Run run) -> const Latency& {
    return (*timed)[static_cast<std::size_t>(run)].latency;
  };
  const auto stage = [&](Run run, Stage s) {
    return 1e3 * seconds(latency(run).stage_percentile(s, 0.5));
  };
  const auto frame = [&](Run run) { return 1e3 * seconds(latency(run).frame_percentile(0.5)); };
  ThesisTables tables{workload.name, {}, {}};
  tables.functions = {
      {"resolution downsampling, 10 x 10", 5.48, stage(Run::kLine10, Stage::kPreprocess)},
      {"point extraction, full resolution", 19.16, stage(Run::kPoints, Stage::kPreprocess)},
      {"fast voxel traversal + map update, 10 x 10", 10.49,
       stage(Run::kTraversal10, Stage::kIntegrate)},
      {"line drawing + map update, 10 x 10", 9.77, stage(Run::kLine10, Stage::kIntegrate)}};
  tables.mapping = {
      {"10 x 10 downsampling, no view", 28.475, frame(Run::kLine10), frame(Run::kProjective10)},
      {"8 x 8 downsampling, no view", 36.517, frame(Run::kLine8), frame(Run::kProjective8)},
      {"full resolution, no view", 665.320, frame(Run::kLine1), frame(Run::kProjective1)}};
  return tables;
}

}  // namespace swiftlet::eval
