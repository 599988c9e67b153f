// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/store/loaded_map.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet {

/// The thresholds that a map was made with; the defaults if it does not tell them.
/// Errors: kCorruptInput if the config in the map cannot be read.
[[nodiscard]] Expected<OccupancyThresholds> thresholds_of(const SavedMap& map);

/// Reads a whole map into memory. Errors: those of thresholds_of() and of damaged blocks.
[[nodiscard]] Expected<LoadedMap> read_whole_map(const SavedMap& map);

/// The same of a map of either kind. Errors: those of open_map(), too; with `is_salvaged` damaged
/// blocks are left out.
[[nodiscard]] Expected<LoadedMap> read_whole_map(const std::string& path, bool is_salvaged = false);

}  // namespace swiftlet
