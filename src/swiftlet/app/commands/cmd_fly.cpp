// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/shared_flags.hpp"
#include "swiftlet/app/interrupt.hpp"
#include "swiftlet/app/report/flight_summary.hpp"
#include "swiftlet/app/view/flight_watch.hpp"
#include "swiftlet/config/config_file.hpp"
#include "swiftlet/file/output_file.hpp"
#include "swiftlet/file/text_output.hpp"
#include "swiftlet/session/flight.hpp"

#if SWIFTLET_HAS_EMBREE
#include "swiftlet/fly/flight_task.hpp"
#include "swiftlet/fly/fly.hpp"
#endif

namespace swiftlet::app {

#if SWIFTLET_HAS_EMBREE

namespace {

struct FlyCommand {
  std::string scene;
  std::optional<Eigen::Vector3d> to;
  bool explores = false;
  FlyOptions how;
  std::optional<std::uint64_t> seed;
  std::string map = "swiftlet";
  ConfigInput config;
  std::string track;
  bool is_viewed = false;
  bool stays = false;  ///< the view, after the flight
  StationFlags station;
  bool as_json = false;
};

/// The page of a flight, or null.
Expected<std::unique_ptr<FlightWatch>> start_page(const FlyCommand& command,
                                                  const MapperConfig& config) {
  if (!command.is_viewed) return nullptr;
  if (command.map != "swiftlet") {
    return fail(ErrorCode::kUsage, "--view", "the page shows flights on our own map alone",
                "leave out --map or --view");
  }
  SourceInfo info;
  info.uri = command.scene;
  auto page = FlightWatch::start(command.station, command.scene, flight_meta(info, config));
  if (page) tell_address((*page)->station());
  return page;
}

Faults run_flight(FlyCommand command) {
  if (!command.track.empty()) {
    if (auto allowed =
            check_output(command.track, std::array{std::filesystem::path(command.scene)});
        !allowed)
      return fault_of(std::move(allowed));
  }
  auto task = read_flight_task(command.scene);
  if (!task) return fault_of(std::move(task));
  FlyOptions& how = command.how;
  how.goal_m = command.explores ? std::nullopt : command.to ? command.to : task->goal_m;
  if (!how.goal_m && !command.explores) {
    return {{ErrorCode::kUsage, "fly", "there is no goal in this scene",
             "say where --to x,y,z, or --explore"}};
  }
  how.bounds = task->bounds;
  how.seed = command.seed.value_or(task->scene.seed);
  auto config = load_config(command.config);
  if (!config) return std::move(config).error();
  how.mapper = config->mapper;
  const MapperConfig flown = flown_config();
  if (!config->places.contains("map.voxel_m")) how.mapper.map.voxel_m = flown.map.voxel_m;
  if (!config->places.contains("depth.max_range_m"))
    how.mapper.depth.max_range_m = flown.depth.max_range_m;
  const InterruptGuard guard;
  how.is_unwanted = [&] { return guard.is_interrupted(); };
  auto page = start_page(command, how.mapper);
  if (!page) return fault_of(std::move(page));
  if (*page) {
    how.is_paced = true;
    how.on_course = [&](const Course& course) { (*page)->note(course); };
  }
  auto map =
      *page ? make_swiftlet_map(how.mapper, page->get()) : make_flown_map(command.map, how.mapper);
  if (!map) return fault_of(std::move(map));
  how.counts_measured_time = command.map == "octomap";
  const auto report = fly(task->scene, task->start, how, std::move(*map));
  if (!report) return {report.error()};
  if (*page) (*page)->finish();
  fmt::print("{}\n", command.as_json ? flight_json(*report) : flight_text(*report));
  if (!command.track.empty()) {
    if (auto written = write_text(command.track, track_csv(*report)); !written)
      return fault_of(std::move(written));
  }
  if (*page && command.stays) {
    std::fflush(stdout);
    wait_for(guard);
  }
  if (report->is_success()) return {};
  return {{ErrorCode::kCorruptInput, command.scene,
           fmt::format("the flight ended short of its task: {}", name_of(report->end)),
           how.counts_measured_time ? "the same command flies it again, at this machine's pace"
                                    : "the same command flies it again, to the bit"}};
}

void declare_how(CLI::App& parser, FlyCommand& command) {
  const auto number = [&](const char* name, double& value, const char* unit, const char* what) {
    parser.add_option(name, value, what)->type_name(unit)->capture_default_str();
  };
  number("--speed", command.how.max_speed_mps, "M/S", "at most");
  number("--radius", command.how.body_radius_m, "METRES", "of the ball that holds the vehicle");
  number("--margin", command.how.margin_m, "METRES", "kept from all that is not free");
  number("--comfort", command.how.comfort_m, "METRES", "and so much more where it costs little");
  number("--rate", command.how.rate_hz, "HZ", "of depth images");
  number("--time-limit", command.how.time_limit_s, "SECONDS", "the flight ends after it");
}

}  // namespace

Action declare_fly(CLI::App& parser) {
  auto o = std::make_shared<FlyCommand>();
  parser.add_option("SCENE", o->scene, "as in sim:apartment or random:forest?seed=7")
      ->type_name("")
      ->required();
  CLI::Option* to = declare_place(parser, "--to", o->to, "where to; random scenes have a goal");
  parser.add_flag("--explore", o->explores, "look at everything within reach, then fly home")
      ->excludes(to);
  parser.add_option("--seed", o->seed, "of noise, wind and planner (default: the scene's)")
      ->type_name("N");
  declare_how(parser, *o);
  parser.add_option("--map", o->map, "what to fly on: swiftlet, octomap (at its own pace)")
      ->check(CLI::IsMember({"swiftlet", "octomap"}).description(""))
      ->type_name("MAP")
      ->capture_default_str();
  declare_config_flags(parser, o->config);
  parser.add_option("--track", o->track, "where it flew, as CSV")->type_name("FILE");
  CLI::Option* view =
      parser.add_flag("--view", o->is_viewed, "show map, path and frontier in the browser")
          ->group("Ground station");
  parser.add_flag("--stay", o->stays, "go on showing it after the flight, until Ctrl-C")
      ->needs(view)
      ->group("Ground station");
  declare_station_flags(parser, o->station);
  parser.add_flag("--json", o->as_json, "one JSON object, for machines");
  parser.footer(
      "Examples:\n"
      "  swiftlet fly sim:apartment --to 8.4,1.7,1.3\n"
      "  swiftlet fly sim:apartment --explore\n"
      "  swiftlet fly random:forest?seed=7 --view      then open the address it tells\n"
      "  swiftlet fly random:forest?seed=7 --speed 3 --json\n"
      "Flies a simulated vehicle on nothing but the map that it makes on the way, and tells how\n"
      "near it came to the true scene. Exit code 1 if it did not do what it was to.");
  return [o] { return run_flight(*o); };
}

#else

Action declare_fly(CLI::App& parser) {
  parser.footer("Examples:\n  swiftlet fly: this build has no simulated rig to fly");
  return [] {
    return Faults{{ErrorCode::kUnsupported, "fly", "this build has no simulated rig",
                   "install libembree-dev and configure with -DSWIFTLET_WITH_EMBREE=ON"}};
  };
}

#endif

}  // namespace swiftlet::app
