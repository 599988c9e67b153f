// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "swiftlet/app/command.hpp"
#include "swiftlet/app/commands/shared_flags.hpp"
#include "swiftlet/app/report/bag_summary.hpp"
#include "swiftlet/app/report/map_report.hpp"
#include "swiftlet/app/report/summary.hpp"
#include "swiftlet/app/visible_text.hpp"
#include "swiftlet/bag/file_or_recording.hpp"
#include "swiftlet/session/flight_file.hpp"
#include "swiftlet/store/opened_map.hpp"

namespace swiftlet::app {
namespace {

struct InfoOptions {
  std::string map;
  bool as_json = false;
  bool is_salvaged = false;
};

/// The corners of the known voxels [m, world].
struct Bounds {
  Eigen::Vector3d low;
  Eigen::Vector3d high;
};

std::optional<Bounds> bounds_of(const SavedMap& map, const MapSummary& summary) {
  if (!summary.bounds) return std::nullopt;
  const Eigen::Vector3d half = Eigen::Vector3d::Constant(0.5 * map.voxel_m());
  return Bounds{centre_of(summary.bounds->first, map.voxel_m()) - half,
                centre_of(summary.bounds->last, map.voxel_m()) + half};
}

std::uintmax_t bytes_of(const SavedMap& map) {
  std::error_code unreadable;
  const auto bytes = std::filesystem::file_size(map.path(), unreadable);
  return unreadable ? 0 : bytes;
}

void print_text(const SavedMap& map, const MapSummary& summary, const std::string& note) {
  fmt::print("{} ({})\n", visible(map.path().string()), size_text(bytes_of(map)));
  fmt::print("  frames     {}\n", map.frames());
  fmt::print("  voxels     {} occupied, {} free, {} unknown in {} blocks\n",
             summary.voxels.occupied, summary.voxels.free, summary.voxels.unknown,
             map.block_count());
  fmt::print("  voxel size {} m\n", map.voxel_m());
  if (const auto b = bounds_of(map, summary)) {
    fmt::print("  bounds     x {:.2f} .. {:.2f}, y {:.2f} .. {:.2f}, z {:.2f} .. {:.2f} m\n",
               b->low.x(), b->high.x(), b->low.y(), b->high.y(), b->low.z(), b->high.z());
  }
  if (!note.empty()) fmt::print("  note       {}\n", visible(note));
  for (const auto& [name, text] : map.meta()) {
    if (name == "frames" || name == "voxel_m") continue;
    if (text.find('\n') == std::string::npos) {
      fmt::print("  {:10} {}\n", visible(name), visible(text));
      continue;
    }
    fmt::print("  {}\n", visible(name));
    for (std::size_t begin = 0; begin < text.size();) {
      const std::size_t end = std::min(text.find('\n', begin), text.size());
      fmt::print("    {}\n", visible(text.substr(begin, end - begin)));
      begin = end + 1;
    }
  }
}

void print_json(const OpenedMap& opened, const MapSummary& summary, const std::string& note) {
  const SavedMap& map = opened.file;
  nlohmann::ordered_json json{
      {"path", map.path().string()},
      {"bytes", bytes_of(map)},
      {"frames", map.frames()},
      {"voxel_m", map.voxel_m()},
      {"blocks", map.block_count()},
      {"voxels",
       {{"occupied", summary.voxels.occupied},
        {"free", summary.voxels.free},
        {"unknown", summary.voxels.unknown}}},
      {"meta", map.meta()},
  };
  if (const auto b = bounds_of(map, summary)) {
    json["bounds_m"] = {{"low", {b->low.x(), b->low.y(), b->low.z()}},
                        {"high", {b->high.x(), b->high.y(), b->high.z()}}};
  }
  if (!note.empty()) json["note"] = note;
  if (opened.salvage) json["salvage"] = salvage_json(*opened.salvage);
  fmt::print("{}\n", json_text(json));
}

Faults info_on_bag(const InfoOptions& options) {
  auto bag = summarize_bag(options.map);
  if (!bag) return fault_of(std::move(bag));
  fmt::print("{}", options.as_json ? bag_json(*bag) : bag_text(*bag));
  if (bag->fault) return {*bag->fault};
  return {};
}

Faults info_on_octomap(const InfoOptions& options) {
  auto octomap = read_octomap(options.map);
  if (!octomap) return fault_of(std::move(octomap));
  std::error_code unreadable;
  const auto bytes = std::filesystem::file_size(options.map, unreadable);
  fmt::print("{}", options.as_json ? octomap_json(options.map, bytes, *octomap)
                                   : octomap_text(options.map, bytes, *octomap));
  return {};
}

Faults info(const InfoOptions& options) {
  auto facts = look_at_file_or_recording(options.map);
  if (!facts) return fault_of(std::move(facts));
  if (facts->kind == FileKind::kBag) return info_on_bag(options);
  if (facts->kind == FileKind::kOctomap) return info_on_octomap(options);
  if (facts->kind != FileKind::kMap && !options.is_salvaged)
    return {wrong_kind(options.map, *facts, "a map (.swl, .bt or .ot) or a recording of ROS")};
  auto map = open_and_tell(options.map, options.is_salvaged);
  if (!map) return fault_of(std::move(map));
  auto summary = summarize(map->file);
  if (!summary) return fault_of(std::move(summary));
  const std::string note = cut_off_note(options.map, map->file.meta());
  options.as_json ? print_json(*map, *summary, note) : print_text(map->file, *summary, note);
  return {};
}

}  // namespace

Action declare_info(CLI::App& parser) {
  auto o = std::make_shared<InfoOptions>();
  parser.add_option("MAP", o->map, "map file: .swl, .bt or .ot; or a recording of ROS")
      ->type_name("")
      ->required();
  parser.add_flag("--json", o->as_json, "one JSON object, for machines");
  declare_salvage(parser, o->is_salvaged);
  parser.footer(
      "Examples:\n"
      "  swiftlet info flat.swl\n"
      "  swiftlet info flat.swl --json | jq .voxels\n"
      "  swiftlet info flight.mcap      lists its topics and what of them would be mapped; .db3,\n"
      "                                 .bag and the folder of `ros2 bag record`, too");
  return [o] { return info(*o); };
}

}  // namespace swiftlet::app
