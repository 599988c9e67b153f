// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

#include "swiftlet/map/block_map.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet {

/// Reads a whole map file into memory. Errors: those of damaged blocks.
[[nodiscard]] Expected<BlockMap> read_whole_map(const SavedMap& map);

/// The same of a map of either kind, ours or an OctoMap. Errors: those of open_map(), too; with
/// `is_salvaged` damaged blocks are left out.
[[nodiscard]] Expected<BlockMap> read_whole_map(const std::string& path, bool is_salvaged = false);

}  // namespace swiftlet
