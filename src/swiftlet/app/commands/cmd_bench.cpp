// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <utility>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/config_warnings.hpp"
#include "swiftlet/app/progress.hpp"
#include "swiftlet/app/report/bench_report.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::app {
namespace {

struct BenchOptions {
  std::vector<std::string> sources{"sim:apartment"};
  eval::WorkloadOptions workload;
  std::vector<double> voxels_m{0.2, 0.1, 0.05};
  std::vector<int> threads{1, 2};
  std::string model = IntegrateOptions{}.model;
  std::string fusion;    ///< --model as the version before called it
  double range_m = 0.0;  ///< 0: as the kind of source demands
  bool with_tables = false;
  bool as_json = false;
};

/// The setting of the thesis, its rule: one reading, the nearest, for 8 x 8 pixels (table 4.1).
constexpr double kThesisVoxel_m = 0.2;
constexpr int kThesisDownsample = 8;

/// What the measurements share; every parameter that counts is named, whatever the defaults are.
MapperConfig base_config(const BenchOptions& options, double max_range_m, double baseline_m) {
  MapperConfig config;
  config.depth.max_range_m = max_range_m;
  config.depth.downsample = 1;
  config.sensor.baseline_m = baseline_m;
  config.integrate.ray_method = "voxel_traversal";
  config.integrate.model = options.model;
  return config;
}

/// Told before minutes are spent on reading frames.
Faults faults_of(const BenchOptions& options) {
  for (const std::string& address : options.sources) {
    MapperConfig config =
        base_config(options, eval::range_of(address, options.workload), SensorOptions{}.baseline_m);
    for (const double voxel_m : options.voxels_m) {
      config.map.voxel_m = voxel_m;
      if (auto faults = config.faults(); !faults.empty()) return faults;
    }
  }
  return {};
}

class Bench {
 public:
  Bench(const BenchOptions& options, const eval::Workload& workload)
      : options_(options), workload_(workload) {}

  /// All subjects at one voxel size.
  Expected<std::vector<eval::BenchRow>> at_full_resolution(double voxel_m) const {
    MapperConfig config = base();
    config.map.voxel_m = voxel_m;
    std::vector<eval::TimedSubject> timed;
    for (const int threads : options_.threads) {
      config.integrate.threads = threads;
      if (auto added = add(timed, "projective", config, 1); !added)
        return forward_error(std::move(added));
    }
    config.integrate.threads = 1;
    // A hundred times slower: a few frames tell as much.
    if (auto added = add(timed, "rays", config, eval::every_nth(10, workload_)); !added)
      return forward_error(std::move(added));
    add_octomap(timed, config);
    tell(fmt::format("{}: voxels of {} m", workload_.name, voxel_m));
    eval::race(workload_, timed, shown_progress());
    return eval::rows_of(workload_, voxel_m, timed, model_note());
  }

  Expected<std::vector<eval::BenchRow>> at_thesis_setting() const {
    MapperConfig config = base();
    config.integrate.model = kThesisModel;
    config.map.voxel_m = kThesisVoxel_m;
    config.depth.downsample = kThesisDownsample;
    std::vector<eval::TimedSubject> timed;
    for (const char* name : {"projective", "rays"}) {
      if (auto added = add(timed, name, config, 1); !added) return forward_error(std::move(added));
    }
    tell(fmt::format("{}: the thesis's setting", workload_.name));
    eval::race(workload_, timed, shown_progress());
    return eval::rows_of(workload_, kThesisVoxel_m, timed,
                         fmt::format(", n = {}", kThesisDownsample));
  }

  Expected<eval::ThesisTables> thesis_tables() const {
    tell(fmt::format("{}: the thesis's tables", workload_.name));
    return eval::measure_thesis_tables(workload_, base(), shown_progress());
  }

  /// What is being done, beside the progress of it.
  static void tell(const std::string& text) { std::fputs((visible(text) + "\n").c_str(), stderr); }

 private:
  /// For the name of the workload, where the measurement model is not the usual one.
  [[nodiscard]] std::string model_note() const {
    return options_.model == IntegrateOptions{}.model ? "" : ", " + options_.model;
  }

  [[nodiscard]] MapperConfig base() const {
    return base_config(options_, workload_.max_range_m, workload_.baseline_m);
  }

  static Status add(std::vector<eval::TimedSubject>& timed, const char* name, MapperConfig config,
                    std::size_t every) {
    config.integrate.integrator = name;
    auto subject = eval::make_mapper_subject(config);
    if (!subject) return forward_error(std::move(subject));
    timed.push_back({.name = name,
                     .threads = config.integrate.threads,
                     .every = every,
                     .subject = std::move(*subject)});
    return Done{};
  }

  void add_octomap(std::vector<eval::TimedSubject>& timed, const MapperConfig& config) const {
    for (const bool is_discretised : {false, true}) {
      auto subject = eval::make_octomap_subject(config, is_discretised);
      if (!subject) continue;
      timed.push_back({.name = is_discretised ? eval::kOctomapDiscretised : eval::kOctomapPlain,
                       .every = is_discretised ? 1 : eval::every_nth(4, workload_),
                       .subject = std::move(subject)});
    }
  }

  const BenchOptions& options_;
  const eval::Workload& workload_;
};

eval::WorkloadOptions with_progress(eval::WorkloadOptions options) {
  options.progress = shown_progress();
  return options;
}

struct Result {
  std::vector<std::string> workloads;
  std::vector<eval::BenchRow> rows;
  std::vector<eval::ThesisTables> tables;
};

Status measure(FrameSource& source, const BenchOptions& options, Result& result) {
  Bench::tell(fmt::format("{}: reading frames", source.info().uri));
  const auto workload = eval::read_workload(source, with_progress(options.workload));
  if (!workload) return tl::make_unexpected(workload.error());
  result.workloads.push_back(eval::workload_text(*workload));
  const Bench bench(options, *workload);
  const auto keep = [&](Expected<std::vector<eval::BenchRow>>&& rows) -> Status {
    if (!rows) return forward_error(std::move(rows));
    result.rows.insert(result.rows.end(), rows->begin(), rows->end());
    return Done{};
  };
  for (const double voxel_m : options.voxels_m) {
    if (auto kept = keep(bench.at_full_resolution(voxel_m)); !kept) return kept;
  }
  if (auto kept = keep(bench.at_thesis_setting()); !kept) return kept;
  if (!options.with_tables) return Done{};
  auto tables = bench.thesis_tables();
  if (!tables) return forward_error(std::move(tables));
  result.tables.push_back(std::move(*tables));
  return Done{};
}

void print(const Result& result, bool as_json) {
  if (as_json) {
    auto json = rows_json(eval::this_machine(), result.rows);
    for (const eval::ThesisTables& tables : result.tables)
      json["tables"].push_back(tables_json(tables));
    fmt::print("{}\n", json_text(json));
    return;
  }
  fmt::print("{}", machine_text(eval::this_machine()));
  for (const std::string& workload : result.workloads) fmt::print("{}", workload);
  fmt::print("\n{}", rows_text(result.rows));
#if !SWIFTLET_HAS_OCTOMAP
  fmt::print("OctoMap was not built; configure with -DSWIFTLET_WITH_OCTOMAP=ON to compare.\n");
#endif
  for (const eval::ThesisTables& tables : result.tables) fmt::print("\n{}", tables_text(tables));
}

Faults bench(BenchOptions options) {
  if (!options.fusion.empty()) {
    tell_renamed("bench", "--fusion", "--model");
    options.model = options.fusion;
  }
  options.model = current_model(options.model, "--model");
  if (options.range_m != 0.0) options.workload.max_range_m = options.range_m;
  if (auto faults = faults_of(options); !faults.empty()) return faults;
  std::vector<FrameSourcePtr> opened;
  for (const std::string& address : options.sources) {
    auto source = open_source(address);
    if (!source) return fault_of(std::move(source));
    opened.push_back(std::move(*source));
  }
  Result result;
  for (FrameSourcePtr& source : opened) {
    if (auto done = measure(*source, options, result); !done) return fault_of(std::move(done));
    source.reset();  // and with it its scene or recording
  }
  print(result, options.as_json);
  return {};
}

}  // namespace

Action declare_bench(CLI::App& parser) {
  auto o = std::make_shared<BenchOptions>();
  const auto range = [](double first, double last) {
    CLI::Range limits(first, last);
    limits.description("");
    return limits;
  };
  parser.add_option("SOURCE", o->sources, "where frames come from, as KIND:PLACE")
      ->type_name("")
      ->default_str("sim:apartment");
  parser.add_option("--frames", o->workload.frames, "frames to measure, held in memory")
      ->check(range(1, 100'000))
      ->type_name("N")
      ->capture_default_str();
  parser.add_option("--warm-up", o->workload.warm_up, "frames before them, not measured")
      ->check(range(0, 100'000))
      ->type_name("N")
      ->capture_default_str();
  parser.add_option("--voxel", o->voxels_m, "edges of a voxel, as in 0.2,0.05")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("M")
      ->default_str("0.2,0.1,0.05");
  parser.add_option("--threads", o->threads, "numbers of threads, as in 1,2,4")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(range(1, 64))
      ->type_name("N")
      ->default_str("1,2");
  parser.add_option("--model", o->model, "integrate.model of our maps")
      ->type_name("NAME")
      ->capture_default_str();
  parser.add_option("--fusion", o->fusion)->group("");  // what --model was called before
  parser.add_option("--range", o->range_m, "drop readings beyond; else 10 for sim:, 5 for others")
      ->check(range(0.1, 100.0))
      ->type_name("M");
  parser.add_flag("--tables", o->with_tables, "also tables 4.2 and 4.3 of the thesis");
  parser.add_flag("--json", o->as_json, "one JSON object, for machines");
  parser.footer(
      "Examples:\n"
      "  swiftlet bench                                    the simulated flat, in a few minutes\n"
      "  swiftlet bench --tables 7scenes:redkitchen/seq-01\n"
      "  swiftlet bench sim:wall --voxel 0.05 --threads 1,2,4 --json\n"
      "From the raw depth image, every pixel of it, and the pose to the updated map, frame by\n"
      "frame and interleaved with OctoMap, whose time includes its point cloud. 'rays' and plain\n"
      "OctoMap are slow and get fewer frames, as the table says.");
  return [o] { return bench(*o); };
}

}  // namespace swiftlet::app
