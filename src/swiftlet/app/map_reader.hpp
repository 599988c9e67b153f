// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

#include "swiftlet/app/loaded_map.hpp"
#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/store/saved_map.hpp"

namespace swiftlet::app {

/// The thresholds that a map was made with; the defaults if it does not tell them.
/// Errors: kCorruptInput if the config in the map cannot be read.
[[nodiscard]] Expected<OccupancyThresholds> thresholds_of(const SavedMap& map);

/// Reads a whole map of either kind into memory. Errors: those of open_map(), thresholds_of() and
/// of damaged blocks; with `is_salvaged` damaged blocks are left out and told, see open_map().
[[nodiscard]] Expected<LoadedMap> read_whole_map(const std::string& path, bool is_salvaged = false);

}  // namespace swiftlet::app
