// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/flight_experiment.hpp"
#include "swiftlet/app/progress.hpp"
#include "swiftlet/app/report/experiment_report.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/eval/thesis/experiment.hpp"
#include "swiftlet/file/text_output.hpp"

namespace swiftlet::app {
namespace {

struct ExperimentOptions {
  std::string name = "all";
  std::string out = "experiments";
  FlightExperiment flights;
  bool as_json = false;
};

Expected<eval::ExperimentRun> run_one(const Registered<eval::RunExperiment>& experiment) {
  std::fputs(fmt::format("{}: {}\n", experiment.name, experiment.summary).c_str(), stderr);
  const auto start = std::chrono::steady_clock::now();
  auto result = experiment.make(shown_progress());
  if (!result) return forward_error(std::move(result));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  return eval::ExperimentRun{std::string(experiment.name), std::string(experiment.summary),
                             std::move(*result), took.count()};
}

void print(const std::vector<eval::ExperimentRun>& runs, const ExperimentOptions& options) {
  if (options.as_json) {
    fmt::print("{}\n", json_text(experiments_json(runs)));
    return;
  }
  for (const eval::ExperimentRun& run : runs) {
    fmt::print("{} ({:.1f} s)\n", run.name, run.seconds);
    for (const eval::Check& check : run.result.checks) {
      fmt::print("  {}  {}: {} (expected: {})\n", check.is_passed ? "passed" : "FAILED", check.what,
                 check.got, check.expected);
    }
  }
  fmt::print("report: {}\n", (std::filesystem::path(options.out) / "report.html").string());
}

/// Not one of the thesis, and hours long if many flights are asked for: only by its name.
Faults fly_experiment(const ExperimentOptions& options) {
  FlightExperiment flights = options.flights;
  flights.folder = options.out;
  flights.as_json = options.as_json;
  return run_flight_experiment(flights);
}

Faults experiment(const ExperimentOptions& options) {
  if (options.name == "fly") return fly_experiment(options);
  if (auto made = make_folder(options.out); !made) return fault_of(std::move(made));
  std::vector<eval::ExperimentRun> runs;
  for (const auto& known : eval::experiments()) {
    if (options.name != "all" && options.name != known.name) continue;
    auto run = run_one(known);
    if (!run) return fault_of(std::move(run));
    runs.push_back(std::move(*run));
  }
  if (runs.empty())
    return fault_of(find_registered(eval::experiments(), options.name, "experiment"));
  if (auto written = write_report(runs, options.out); !written) return fault_of(std::move(written));
  print(runs, options);
  Faults faults;
  for (const eval::ExperimentRun& run : runs) {
    if (!run.result.is_passed())
      faults.push_back({ErrorCode::kCorruptInput, run.name,
                        "a result of the thesis was not reproduced", "see the report"});
  }
  return faults;
}

}  // namespace

Action declare_experiment(CLI::App& parser) {
  auto o = std::make_shared<ExperimentOptions>();
  parser.add_option("NAME", o->name, "one of 'swiftlet list experiments', all, or fly")
      ->type_name("")
      ->capture_default_str();
  parser.add_option("-o,--out", o->out, "folder for report.html and its figures; fly: flights.csv")
      ->type_name("FOLDER")
      ->capture_default_str();
  parser.add_option("--flights", o->flights.flights, "fly: of each kind of scene on each map")
      ->check(CLI::Range(1, 10'000).description(""))
      ->type_name("N")
      ->capture_default_str();
  parser.add_option("--speed", o->flights.max_speed_mps, "fly: at most")
      ->type_name("M/S")
      ->capture_default_str();
  parser.add_flag("--json", o->as_json, "the results as one JSON object, for machines");
  parser.footer(
      "Examples:\n"
      "  swiftlet experiment all -o experiments\n"
      "  swiftlet experiment large_box --json\n"
      "  swiftlet experiment fly --flights 40 -o flights   random scenes, on our map and "
      "OctoMap's\n"
      "Repeats the experiments of the thesis on the simulated rig and says of each whether its\n"
      "result was reproduced (exit code 1 if one was not). The report is one page that needs no\n"
      "network; gnuplot draws its figures.");
  return [o] { return experiment(*o); };
}

}  // namespace swiftlet::app
