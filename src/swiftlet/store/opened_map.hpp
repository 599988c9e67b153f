// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string>

#include "swiftlet/file/private_folder.hpp"
#include "swiftlet/store/map_file/salvage.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet {

/// A map that a command reads; an OctoMap is first laid out into one of ours, which is gone with
/// this object.
struct OpenedMap {
  /// Of an OctoMap that was laid out; outlives the map in it.
  std::optional<PrivateFolder> folder;
  SavedMap file;                           ///< the map
  std::optional<SalvageReport> salvage{};  ///< if it was asked for
};

/// Opens a map of either kind, told by its content; with `is_salvaged` what can be read of a
/// damaged one of ours, and the report of it. Errors: those of load_map(),
/// load_salvaged() and read_octomap_blocks(); kCorruptInput for other files, saying what they are.
[[nodiscard]] Expected<OpenedMap> open_map(const std::string& path, bool is_salvaged = false);

}  // namespace swiftlet
