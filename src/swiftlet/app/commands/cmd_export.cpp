// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <memory>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/shared_flags.hpp"
#include "swiftlet/file/output_file.hpp"
#include "swiftlet/store/export/exporters.hpp"

namespace swiftlet::app {
namespace {

struct ExportOptions {
  std::string map;
  std::string format;
  std::string out;
  bool is_salvaged = false;
};

Faults write_export(const ExportOptions& options) {
  if (auto allowed = check_output(options.out, std::array{std::filesystem::path(options.map)});
      !allowed) {
    return fault_of(std::move(allowed));
  }
  auto map = open_and_tell(options.map, options.is_salvaged);
  if (!map) return fault_of(std::move(map));
  auto written = export_map(options.format, map->file, options.out);
  if (!written) return fault_of(std::move(written));
  fmt::print("{}\n", options.out);
  if (options.format != "pcd") return {};
  const auto origin = pcd_origin(map->file);
  if (origin && !origin->isZero()) {
    fmt::print("far from the origin: add ({}, {}, {}) m to its points, as its header says\n",
               origin->x(), origin->y(), origin->z());
  }
  return {};
}

}  // namespace

Action declare_export(CLI::App& parser) {
  auto o = std::make_shared<ExportOptions>();
  parser.add_option("MAP", o->map, "map file: .swl, .bt or .ot")->type_name("")->required();
  parser.add_option("--to", o->format, "format, see 'swiftlet list exporters'")
      ->type_name("NAME")
      ->required();
  parser.add_option("-o,--out", o->out, "file to write")->type_name("FILE")->required();
  declare_salvage(parser, o->is_salvaged);
  parser.footer(
      "Examples:\n"
      "  swiftlet export flat.swl --to ply -o flat.ply    points for CloudCompare or MeshLab\n"
      "  swiftlet export flat.swl --to mcap -o flat.mcap  a cloud for Foxglove and Rerun\n"
      "  swiftlet export flat.swl --to bt -o flat.bt      an OctoMap for ROS");
  return [o] { return write_export(*o); };
}

}  // namespace swiftlet::app
