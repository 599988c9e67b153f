// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "swiftlet/store/private_folder.hpp"
#include "swiftlet/store/salvage.hpp"
#include "swiftlet/store/saved_map.hpp"

namespace swiftlet::app {

/// A map that a command reads; an OctoMap is first laid out into one of ours, which is gone with
/// this object.
struct OpenedMap {
  std::optional<PrivateFolder> folder;  // outlives the map in it
  SavedMap file;
  std::optional<SalvageReport> salvage{};  ///< if it was asked for
};

/// Adds the option --salvage.
void declare_salvage(CLI::App& parser, bool& is_salvaged);

/// Opens a map of either kind, told by its content; with `is_salvaged` what can be read of a
/// damaged one of ours: then standard error tells what is missing. Errors: those of load_map(),
/// load_salvaged() and read_octomap_blocks(); kCorruptInput for other files, saying what they are.
[[nodiscard]] Expected<OpenedMap> open_map(const std::string& path, bool is_salvaged = false);

}  // namespace swiftlet::app
