// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <memory>
#include <string>

#include "swiftlet/app/loaded_map.hpp"
#include "swiftlet/app/private_folder.hpp"
#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/store/saved_map.hpp"

namespace swiftlet::app {

/// The thresholds that a map was made with; the defaults if it does not tell them.
/// Errors: kCorruptInput if the config in the map cannot be read.
[[nodiscard]] Expected<OccupancyThresholds> thresholds_of(const SavedMap& map);

/// A map of ours; an OctoMap is first laid out into one, which is gone with this object.
struct OpenedMap {
  std::unique_ptr<PrivateFolder> folder;  // outlives the map in it
  SavedMap map;
};

/// Opens a map of either kind, told by its content. Errors: those of load_map() and
/// read_octomap_blocks(); kCorruptInput for other files, saying what they are.
[[nodiscard]] Expected<OpenedMap> open_map(const std::string& path);

/// Reads a whole map of either kind into memory. Errors: those of open_map(), thresholds_of() and
/// of damaged blocks.
[[nodiscard]] Expected<LoadedMap> read_whole_map(const std::string& path);

}  // namespace swiftlet::app
