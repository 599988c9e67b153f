// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <utility>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/shared_flags.hpp"
#include "swiftlet/app/config_warnings.hpp"
#include "swiftlet/app/progress.hpp"
#include "swiftlet/app/report/score_report.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/eval/bench/bench_workload.hpp"
#include "swiftlet/eval/score/score_job.hpp"
#include "swiftlet/integrate/measurement_models.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::app {
namespace {

struct ScoreOptions {
  std::string source;
  ConfigInput config;
  std::vector<std::string> maps;
  std::size_t frames = eval::ScoreJob{}.frames;
  bool as_json = false;
};

/// The parameters as the user gives them; range and baseline are the source's, if he does not.
tl::expected<eval::ScoreJob, Faults> job_of(const ScoreOptions& options) {
  auto config = load_config(options.config);
  if (!config) return tl::make_unexpected(std::move(config).error());
  tell_warnings(*config);
  auto source = open_source(options.source);
  if (!source) return tl::make_unexpected(fault_of(std::move(source)));
  adopt_baseline((*source)->info().baseline_m, *config);
  if (!config->places.contains("depth.max_range_m"))
    config->mapper.depth.max_range_m = eval::range_of(options.source, {});
  eval::ScoreJob job{options.source, config->mapper, options.maps, options.frames,
                     shown_progress()};
  for (std::string& map : job.maps) map = current_model(map, "--maps");
  if (job.maps.empty()) {
    for (const auto& model : measurement_models()) job.maps.emplace_back(model.name);
    if (eval::make_octomap_subject(config->mapper, false)) job.maps.emplace_back(eval::kOctomap);
  }
  return job;
}

Faults score(const ScoreOptions& options) {
  auto job = job_of(options);
  if (!job) return std::move(job).error();
  auto report = eval::score_source(*job);
  job->progress = {};  // the line of the last work ends
  if (!report) return fault_of(std::move(report));
  if (options.as_json) {
    fmt::print("{}\n", json_text(score_json(*report)));
  } else {
    fmt::print("{}", score_text(*report));
  }
  return {};
}

}  // namespace

Action declare_score(CLI::App& parser) {
  auto o = std::make_shared<ScoreOptions>();
  CLI::Range positive(1, 1'000'000);
  positive.description("");
  parser.add_option("SOURCE", o->source, "where frames come from, as KIND:PLACE")
      ->type_name("")
      ->required();
  parser
      .add_option("--maps", o->maps,
                  "measurement models or integrators, and octomap; default: all models, octomap")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAMES");
  parser.add_option("--frames", o->frames, "of a simulated flight, evenly over it")
      ->check(positive)
      ->type_name("N")
      ->capture_default_str();
  declare_config_flags(parser, o->config);
  parser.add_flag("--json", o->as_json, "one JSON object with every voxel, for machines");
  parser.footer(
      "Examples:\n"
      "  swiftlet score sim:apartment --set map.voxel_m=0.1\n"
      "  swiftlet score sim:wires --maps precision_weighted,octomap --set map.voxel_m=0.1\n"
      "  swiftlet score 7scenes:redkitchen/seq-01 --set map.voxel_m=0.05\n"
      "A simulated flight is judged by the truth: where matter is, and what of it could be seen\n"
      "from the poses that were flown. Of a recording every fifth frame is left out, and the map\n"
      "of the others must predict it. 'swiftlet list scores' tells what is measured,\n"
      "docs/accuracy.md how each is defined.");
  return [o] { return score(*o); };
}

}  // namespace swiftlet::app
