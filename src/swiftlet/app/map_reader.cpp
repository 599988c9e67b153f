// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/map_reader.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <locale>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include "swiftlet/app/config_file.hpp"
#include "swiftlet/app/file_kind.hpp"
#include "swiftlet/store/octomap_blocks.hpp"
#include "swiftlet/store/save_blocks.hpp"

namespace swiftlet::app {
namespace {

constexpr std::string_view kWanted = "a map (.swl, .bt or .ot)";

Expected<OpenedMap> lay_out_octomap(const std::string& path) {
  auto laid_out = read_octomap_blocks(path, OccupancyThresholds{});
  if (!laid_out) return forward_error(std::move(laid_out));
  auto folder = std::make_unique<PrivateFolder>();
  if (folder->path().empty()) {
    return fail(ErrorCode::kIo, path, "there is no room for temporary files",
                "set TMPDIR to a folder that can be written to");
  }
  const auto copy = std::filesystem::path(folder->path()) / "map.swl";
  const std::vector<std::pair<BlockIndex, VoxelBlock>> blocks(laid_out->blocks.begin(),
                                                              laid_out->blocks.end());
  const MapMeta meta{{"voxel_m", fmt::format("{}", laid_out->summary.voxel_m)},
                     {"frames", "0"},
                     {"source", "OctoMap " + path},
                     {"logodds_per_step", fmt::format("{}", OctomapBlocks::kLogoddsPerStep)}};
  if (auto saved = save_blocks(copy, blocks, meta); !saved) return forward_error(std::move(saved));
  auto map = load_map(copy);
  if (!map) return forward_error(std::move(map));
  return OpenedMap{std::move(folder), std::move(*map)};
}

Expected<LoadedMap> read_whole_octomap(const std::string& path) {
  auto laid_out = read_octomap_blocks(path, OccupancyThresholds{});
  if (!laid_out) return forward_error(std::move(laid_out));
  return LoadedMap{
      laid_out->summary.voxel_m, OccupancyThresholds{}, std::move(laid_out->blocks), {0, 0, 0}};
}

}  // namespace

Expected<OccupancyThresholds> thresholds_of(const SavedMap& map) {
  const auto yaml = map.meta().find("config");
  if (yaml == map.meta().end()) return OccupancyThresholds{};
  auto config = parse_config(yaml->second, map.path().string() + ": config");
  if (config) return config->mapper.occupancy;
  Error fault = config.error().front();
  fault.code = ErrorCode::kCorruptInput;  // not the user's config of this command
  return tl::make_unexpected(std::move(fault));
}

Expected<OpenedMap> open_map(const std::string& path) {
  auto facts = look_at_file(path);
  if (!facts) return forward_error(std::move(facts));
  if (facts->kind == FileKind::kOctomap) return lay_out_octomap(path);
  if (facts->kind != FileKind::kMap) return tl::make_unexpected(wrong_kind(path, *facts, kWanted));
  auto map = load_map(path);
  if (!map) return forward_error(std::move(map));
  return OpenedMap{nullptr, std::move(*map)};
}

Expected<LoadedMap> read_whole_map(const std::string& path) {
  auto facts = look_at_file(path);
  if (!facts) return forward_error(std::move(facts));
  if (facts->kind == FileKind::kOctomap) return read_whole_octomap(path);
  if (facts->kind != FileKind::kMap) return tl::make_unexpected(wrong_kind(path, *facts, kWanted));
  auto saved = load_map(path);
  if (!saved) return forward_error(std::move(saved));
  auto thresholds = thresholds_of(*saved);
  if (!thresholds) return forward_error(std::move(thresholds));
  LoadedMap map{saved->voxel_m(), *thresholds};
  const auto start = saved->meta().find("start_m");  // older maps and other writers have none
  if (start != saved->meta().end()) {
    std::istringstream numbers(start->second);
    numbers.imbue(std::locale::classic());
    numbers >> map.start_m.x() >> map.start_m.y() >> map.start_m.z();
  }
  auto read =
      saved->for_each_block([&](const BlockIndex& index, const VoxelBlock& block) -> Status {
        map.blocks.emplace(index, block);
        return Done{};
      });
  if (!read) return forward_error(std::move(read));
  return map;
}

}  // namespace swiftlet::app
