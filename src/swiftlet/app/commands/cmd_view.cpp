// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/shared_flags.hpp"
#include "swiftlet/app/view/map_saver.hpp"
#include "swiftlet/app/view/station_flags.hpp"

namespace swiftlet::app {
namespace {

struct MapViewFlags {
  std::string map;
  StationFlags station;
  bool is_salvaged = false;
};

/// The whole map, and what its file tells of it.
Expected<station::SavedWorld> read_world(const SavedMap& file) {
  station::SavedWorld world;
  world.info.version = SWIFTLET_VERSION;
  world.info.header = file.header();
  world.map = station::MapMirror(file.header());
  auto passed =
      file.for_each_block([&](const BlockIndex& index, const VoxelBlock& block) -> Status {
        world.map.put(index, block, 1);
        return Done{};
      });
  if (!passed) return forward_error(std::move(passed));
  return world;
}

Faults view(const MapViewFlags& flags) {
  auto options = station_options(flags.station);
  if (!options) return fault_of(std::move(options));
  auto opened = open_and_tell(flags.map, flags.is_salvaged);
  if (!opened) return fault_of(std::move(opened));
  const SavedMap* const file = &opened->file;
  auto world = read_world(*file);
  if (!world) return fault_of(std::move(world));
  world->info.source = flags.map;
  options->save_map = map_saver(file->meta());
  const InterruptGuard interrupt;
  auto station = station::Station::start(*options, std::move(*world));
  if (!station) return fault_of(std::move(station));
  tell_address(**station);
  wait_for(interrupt);
  return {};
}

}  // namespace

Action declare_view(CLI::App& parser) {
  auto o = std::make_shared<MapViewFlags>();
  parser.add_option("MAP", o->map, "map file: .swl, .bt or .ot")->type_name("")->required();
  declare_salvage(parser, o->is_salvaged);
  declare_station_flags(parser, o->station);
  parser.footer(
      "Examples:\n"
      "  swiftlet view flat.swl                          then open http://127.0.0.1:8080/\n"
      "  swiftlet view flat.swl --listen 0.0.0.0:8080    for others, too: prints an address with\n"
      "                                                  a token that they must know\n"
      "'swiftlet map SOURCE --view' shows a map while it grows. Ctrl-C ends.\n"
      "What the page shows and how it is kept safe: docs/ground_station.md.");
  return [o] { return view(*o); };
}

}  // namespace swiftlet::app
