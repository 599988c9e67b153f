// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <CLI/App.hpp>
#include <string>

#include "swiftlet/store/map_loader.hpp"
#include "swiftlet/store/opened_map.hpp"

namespace swiftlet::app {

/// Adds the option --salvage.
void declare_salvage(CLI::App& parser, bool& is_salvaged);

/// Opens a map as open_map() does; standard error tells what is missing of a salvaged one.
[[nodiscard]] Expected<OpenedMap> open_and_tell(const std::string& path, bool is_salvaged);

/// Reads a whole map as read_whole_map() does; standard error tells what is missing of a salvaged
/// one.
[[nodiscard]] Expected<BlockMap> read_and_tell(const std::string& path, bool is_salvaged);

}  // namespace swiftlet::app
