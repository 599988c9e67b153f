// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "swiftlet/store/export/octomap_import.hpp"
#include "swiftlet/store/map_file/salvage.hpp"

namespace swiftlet::app {

// What `swiftlet info` tells of an OctoMap, as lines for people and as JSON.
[[nodiscard]] std::string octomap_text(const std::string& path, std::uintmax_t bytes,
                                       const OctomapSummary& octomap);
[[nodiscard]] std::string octomap_json(const std::string& path, std::uintmax_t bytes,
                                       const OctomapSummary& octomap);

/// For machines: what of a damaged map was kept, what is missing, and the same in words.
[[nodiscard]] nlohmann::ordered_json salvage_json(const SalvageReport& report);

}  // namespace swiftlet::app
