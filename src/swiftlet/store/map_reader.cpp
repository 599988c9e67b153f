// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_reader.hpp"

#include <utility>

#include "swiftlet/config/config_file.hpp"
#include "swiftlet/store/opened_map.hpp"

namespace swiftlet {

Expected<OccupancyThresholds> thresholds_of(const SavedMap& map) {
  const auto yaml = map.meta().find("config");
  if (yaml == map.meta().end()) return OccupancyThresholds{};
  auto config = parse_config(yaml->second, map.path().string() + ": config");
  if (config) return config->mapper.occupancy;
  Error fault = config.error().front();
  fault.code = ErrorCode::kCorruptInput;  // not the user's config of this command
  return tl::make_unexpected(std::move(fault));
}

Expected<LoadedMap> read_whole_map(const SavedMap& saved) {
  auto thresholds = thresholds_of(saved);
  if (!thresholds) return forward_error(std::move(thresholds));
  LoadedMap map{saved.voxel_m(), *thresholds};
  // Older maps and other writers have none.
  if (const auto& start = saved.start_m()) map.start_m = {(*start)[0], (*start)[1], (*start)[2]};
  auto read = saved.for_each_block([&](const BlockIndex& index, const VoxelBlock& block) -> Status {
    map.blocks.emplace(index, block);
    return Done{};
  });
  if (!read) return forward_error(std::move(read));
  return map;
}

Expected<LoadedMap> read_whole_map(const std::string& path, bool is_salvaged) {
  auto opened = open_map(path, is_salvaged);
  if (!opened) return forward_error(std::move(opened));
  return read_whole_map(opened->file);
}

}  // namespace swiftlet
