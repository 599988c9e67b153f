// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/map_reader.hpp"

#include <locale>
#include <sstream>

#include "swiftlet/app/config_file.hpp"

namespace swiftlet::app {

Expected<OccupancyThresholds> thresholds_of(const SavedMap& map) {
  const auto yaml = map.meta().find("config");
  if (yaml == map.meta().end()) return OccupancyThresholds{};
  auto config = parse_config(yaml->second, map.path().string() + ": config");
  if (config) return config->mapper.occupancy;
  Error fault = config.error().front();
  fault.code = ErrorCode::kCorruptInput;  // not the user's config of this command
  return tl::make_unexpected(std::move(fault));
}

Expected<LoadedMap> read_whole_map(const std::string& path) {
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
