// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <iterator>
#include <memory>
#include <span>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/rig_flags.hpp"
#include "swiftlet/app/commands/shared_flags.hpp"
#include "swiftlet/app/config_warnings.hpp"
#include "swiftlet/app/events.hpp"
#include "swiftlet/app/interrupt.hpp"
#include "swiftlet/app/progress.hpp"
#include "swiftlet/app/report/summary.hpp"
#include "swiftlet/app/view/autopilot_watch.hpp"
#include "swiftlet/app/view/flight_watch.hpp"
#include "swiftlet/file/output_file.hpp"
#include "swiftlet/session/flight.hpp"
#include "swiftlet/session/flight_file.hpp"
#include "swiftlet/session/flight_recovery.hpp"
#include "swiftlet/session/mapping_session.hpp"
#include "swiftlet/session/observers.hpp"
#include "swiftlet/source/address_options.hpp"
#include "swiftlet/source/rig/real_time_source.hpp"
#include "swiftlet/source/sources.hpp"
#include "swiftlet/station/flight/flight_recorder.hpp"

namespace swiftlet::app {
namespace {

struct MapOptions {
  std::string source;
  std::string out = "map.swl";
  bool overwrite = false;
  ConfigInput config;
  std::string rays;
  std::string store = "keep";
  std::uint64_t max_bytes = 0;
  std::size_t frames = 0;  ///< 0 for all
  RigFlags rig;
  bool in_real_time = false;
  bool as_json = false;
  std::string mcap;  ///< file for the flight; empty: none
  bool is_viewed = false;
  bool stays = false;  ///< the view, after the flight
  StationFlags station;
  MavlinkFlags mavlink;
};

/// Who is told of the flight while it goes on; null where nobody is.
struct Onlookers {
  std::unique_ptr<FlightWatch> page;
  std::unique_ptr<station::FlightRecorder> recorder;
  std::unique_ptr<AutopilotWatch> autopilot;
  Observers all{};
};

Status check_recording_name(const MapOptions& options,
                            std::span<const std::filesystem::path> inputs) {
  if (options.mcap.empty()) return Done{};
  const std::filesystem::path path(options.mcap);
  if (path.lexically_normal() == std::filesystem::path(options.out).lexically_normal())
    return fail(ErrorCode::kUsage, options.mcap, "this is the file of the map, too",
                "choose another name with --mcap");
  if (is_there(path) && !options.overwrite)
    return fail(ErrorCode::kUsage, options.mcap, "the file exists",
                "add --overwrite or choose another name with --mcap");
  return check_output(path, inputs);
}

/// Told before the flight and not after it.
Status check_name_is_free(const MapOptions& options) {
  auto recovered = recover_cut_flights(options.out);
  if (!recovered) return forward_error(std::move(recovered));
  for (const std::string& note : *recovered)
    std::fputs(("swiftlet: " + note + "\n").c_str(), stderr);
  const auto inputs = existing_files(options.source);
  if (auto allowed = check_recording_name(options, inputs); !allowed) return allowed;
  auto free = check_flight_file(options.out, options.overwrite, inputs);
  return free ? check_room_for_flight(options.out) : free;
}

tl::expected<LoadedConfig, Faults> config_of(const MapOptions& options) {
  ConfigInput input = options.config;
  if (!options.rays.empty()) {
    input.settings.emplace_back("integrate.integrator=rays");
    input.settings.push_back("integrate.ray_method=" + options.rays);
  }
  return load_config(input);
}

SessionOptions session_options(const MapOptions& options, const SourceInfo& info,
                               const MapperConfig& config) {
  SessionOptions session;
  session.path = options.out;
  session.store.policy = options.store == "keep" ? StorePolicy::kKeep : StorePolicy::kDrop;
  session.store.max_bytes = options.max_bytes;
  session.store.overwrite = options.overwrite;
  session.meta = flight_meta(info, config);
  return session;
}

FlightOptions flight_options(const MapOptions& options, Progress& progress,
                             const InterruptGuard& interrupt) {
  FlightOptions flight;
  flight.frames = options.frames;
  flight.stop = [&] { return interrupt.is_interrupted(); };
  flight.progress = [&](std::size_t done, auto) { progress.update(done); };
  flight.tell_loss = [&] {
    progress.tell("the disk refuses blocks of the map; the flight goes on without them");
  };
  return flight;
}

Status fly_and_tell(FrameSource& source, MappingSession& session, const MapOptions& options,
                    const InterruptGuard& interrupt, Onlookers& onlookers) {
  Progress progress(options.frames > 0 ? options.frames : source.info().frame_count);
  FlightOptions flight = flight_options(options, progress, interrupt);
  flight.look = [&] {
    const std::uint64_t blocks_lost = session.summary().blocks_lost;
    if (onlookers.page) onlookers.page->note(source.tally(), blocks_lost);
    if (onlookers.recorder) onlookers.recorder->note(source.tally(), blocks_lost);
    if (!onlookers.autopilot) return;
    for (const std::string& note : onlookers.autopilot->take_notes())
      progress.tell("autopilot: " + note);
  };
  flight.tell_events = [&](const std::vector<RigEvent>& events) {
    tell_events(events, progress);
    if (onlookers.autopilot) onlookers.autopilot->tell_pilot(events);
  };
  Status outcome = fly(source, session, flight);
  progress.finish();
  return outcome;
}

/// Saves what there is, whether the flight ended well or not, and tells of it.
Faults land(MappingSession& session, const MapperConfig& config, Status&& flight, bool as_json) {
  Faults faults;
  if (!flight) faults.push_back(std::move(flight).error());
  if (!session.has_map()) {
    if (faults.empty()) faults.push_back(nothing_mapped(session.summary(), config));
    return faults;
  }
  if (auto saved = session.save(); !saved) faults.push_back(std::move(saved).error());
  if (!session.aside().empty()) {
    faults.push_back({ErrorCode::kIo, session.aside().string(),
                      "here is the map that was to be replaced", "remove it if you need it not"});
  }
  fmt::print("{}", as_json ? summary_json(session.summary()) : summary_text(session.summary()));
  return faults;
}

Expected<std::unique_ptr<Onlookers>> start_onlookers(const MapOptions& options, const MapMeta& meta,
                                                     const MapperConfig& config,
                                                     FrameSource& source) {
  auto onlookers = std::make_unique<Onlookers>();
  if (options.is_viewed) {
    auto page = FlightWatch::start(options.station, options.source, meta);
    if (!page) return forward_error(std::move(page));
    tell_address((*page)->station());
    onlookers->page = std::move(*page);
  }
  if (options.mavlink.is_wanted()) {
    auto autopilot = AutopilotWatch::start(options.mavlink, config, source);
    if (!autopilot) return forward_error(std::move(autopilot));
    onlookers->autopilot = std::move(*autopilot);
  }
  if (source.pose_sink() != nullptr && !onlookers->autopilot) {
    return fail(ErrorCode::kUsage, options.source,
                "its poses are the autopilot's, and there is none",
                "add --mavlink LINK (docs/autopilot.md)");
  }
  if (!options.mcap.empty()) {
    auto recorder = station::FlightRecorder::start(options.mcap, options.source, meta);
    if (!recorder) return forward_error(std::move(recorder));
    onlookers->recorder = std::move(*recorder);
  }
  onlookers->all.add(onlookers->page.get());
  onlookers->all.add(onlookers->autopilot.get());
  onlookers->all.add(onlookers->recorder.get());  // last: it may hold up the others
  return onlookers;
}

Faults map(const MapOptions& options) {
  auto config = config_of(options);
  if (!config) return std::move(config).error();
  tell_warnings(*config);
  auto source = open_source(options.rig.added_to(options.source));
  if (!source) return fault_of(std::move(source));
  // Last, since it is the one that changes files.
  if (auto free = check_name_is_free(options); !free) return fault_of(std::move(free));
  if (options.in_real_time) source = play_in_real_time(std::move(*source));
  const SourceInfo info = (*source)->info();
  adopt_baseline(info.baseline_m, *config);

  SessionOptions how = session_options(options, info, config->mapper);
  auto onlookers = start_onlookers(options, how.meta, config->mapper, **source);
  if (!onlookers) return fault_of(std::move(onlookers));
  how.observer = &(*onlookers)->all;
  auto session = MappingSession::create(config->mapper, how);
  if (!session) return fault_of(std::move(session));
  const InterruptGuard interrupt;  // until the map is saved
  Status flight = fly_and_tell(**source, **session, options, interrupt, **onlookers);
  if ((*onlookers)->autopilot) (*onlookers)->autopilot->finish();
  source->reset();  // nobody listens to the rig any more, however long the page stays
  if ((*onlookers)->page) (*onlookers)->page->finish();
  if ((*onlookers)->recorder) (*onlookers)->recorder->finish();
  const bool is_over = flight.has_value() && !(*session)->summary().was_interrupted;
  Faults faults = land(**session, config->mapper, std::move(flight), options.as_json);
  if ((*onlookers)->recorder)
    std::ranges::move((*onlookers)->recorder->close(), std::back_inserter(faults));
  if ((*onlookers)->page && options.stays && is_over && faults.empty()) {
    std::fflush(stdout);
    wait_for(interrupt);
  }
  return faults;
}

}  // namespace

Action declare_map(CLI::App& parser) {
  auto o = std::make_shared<MapOptions>();
  // Without their descriptions, which would stand in the help twice.
  CLI::Range positive(1, 1'000'000'000);
  positive.description("");
  CLI::AsSizeValue size(false);
  size.description("");
  parser.add_option("SOURCE", o->source, "where frames come from, as KIND:PLACE")
      ->type_name("")
      ->required();
  parser.add_option("-o,--out", o->out, "map file to write; %t becomes the time of the start, UTC")
      ->type_name("FILE")
      ->capture_default_str();
  parser.add_flag("--overwrite", o->overwrite,
                  "replace the map; the old one is kept until the new one is saved");
  declare_config_flags(parser, o->config);
  parser
      .add_option(
          "--rays", o->rays,
          "trace rays by this method (integrate.integrator: rays); see 'swiftlet list rays'")
      ->type_name("NAME");
  parser.add_option("--frames", o->frames, "stop after this many frames")
      ->check(positive)
      ->type_name("N");
  parser.add_flag("--realtime", o->in_real_time,
                  "play at recorded speed and lose frames when late, as a live rig does");
  parser
      .add_option("--mcap", o->mcap,
                  "write the flight, too, for Foxglove, Lichtblick and Rerun, and for bag:")
      ->type_name("FILE");
  parser.add_flag("--view", o->is_viewed, "show the map in the browser while it grows")
      ->group("Ground station");
  parser.add_flag("--stay", o->stays, "go on showing it after the flight, until Ctrl-C")
      ->group("Ground station");
  declare_station_flags(parser, o->station);
  declare_rig_flags(parser, o->rig);
  declare_mavlink_flags(parser, o->mavlink);
  parser.add_option("--store", o->store, "what leaves the window: keep it in the file or drop it")
      ->check(CLI::IsMember({"keep", "drop"}))
      ->capture_default_str();
  parser
      .add_option("--max-bytes", o->max_bytes, "cap of the map file, as in 500MB; oldest go first")
      ->transform(size)
      ->type_name("SIZE");
  parser.add_flag("--json", o->as_json, "the summary as one JSON object, for machines");
  parser.footer(
      "Examples:\n"
      "  swiftlet map 7scenes:redkitchen/seq-01 -o kitchen.swl\n"
      "  swiftlet map tum:freiburg1_room --set map.voxel_m=0.05 --set depth.downsample=4\n"
      "  swiftlet map 'tum:flight?depth_unit_m=0.001&intrinsics=615,615,320,240'\n"
      "  swiftlet map sim:apartment --config flight.yaml --overwrite\n"
      "  swiftlet map bag:d435.bag,t265.bag --rig my_rig.yaml\n"
      "  swiftlet map sim:apartment --view --stay --realtime     then open the address it tells\n"
      "  swiftlet map realsense: --rig my_rig.yaml --mavlink serial:/dev/ttyACM0\n"
      "'swiftlet list sources' tells every KIND, 'swiftlet list parameters' every KEY.\n"
      "Ctrl-C stops the flight and saves what was mapped (exit code 0); a second one gives up.\n"
      "A flight that was cut off leaves its map; the next start of the same command keeps it as\n"
      "FILE.<time>.cut.swl. Poses that lose their place begin a new map, FILE.world2.swl.");
  return [o] {
    o->out = with_start_time(std::move(o->out), std::time(nullptr));
    o->mcap = with_start_time(std::move(o->mcap), std::time(nullptr));
    return map(*o);
  };
}

}  // namespace swiftlet::app
