// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Options that several commands have, and what goes with them.

#pragma once

#include <CLI/CLI.hpp>
#include <Eigen/Core>
#include <optional>
#include <string>

#include "swiftlet/config/config_file.hpp"
#include "swiftlet/store/map_loader.hpp"
#include "swiftlet/store/opened_map.hpp"

namespace swiftlet::app {

/// Declares --config and --set.
void declare_config_flags(CLI::App& parser, ConfigInput& config);

/// Declares an option whose value is a place, `x,y,z` [m, world].
CLI::Option* declare_place(CLI::App& parser, const std::string& name,
                           std::optional<Eigen::Vector3d>& place, const std::string& what);

/// Declares --salvage.
void declare_salvage(CLI::App& parser, bool& is_salvaged);

/// Opens a map as open_map() does; standard error tells what is missing of a salvaged one.
[[nodiscard]] Expected<OpenedMap> open_and_tell(const std::string& path, bool is_salvaged);

/// Reads a whole map as read_whole_map() does; standard error tells what is missing of a salvaged
/// one.
[[nodiscard]] Expected<BlockMap> read_and_tell(const std::string& path, bool is_salvaged);

}  // namespace swiftlet::app
