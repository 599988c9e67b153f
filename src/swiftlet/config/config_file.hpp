// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/faults.hpp"
#include "swiftlet/pipeline/mapper_config.hpp"

namespace swiftlet {

/// Where the user's parameters are written. Later ones win: defaults, files and settings in order.
struct ConfigInput {
  std::vector<std::string> files;     ///< YAML, as given with --config
  std::vector<std::string> settings;  ///< "map.voxel_m=0.1", as given with --set
};

/// The parameters, and the place of each that the user gave: key -> "flight.yaml:3" or "--set".
struct LoadedConfig {
  MapperConfig mapper;  ///< checked, defaults where the user gave nothing
  std::map<std::string, std::string, std::less<>> places;  ///< where the user gave what
  Faults warnings;  ///< what was accepted, but will not be by the next version (config_aliases.hpp)
};

/// What is told of a key or value that has another name now.
[[nodiscard]] Error renamed_warning(const std::string& place, std::string_view before,
                                    std::string_view now);

/// Reads and checks parameters: every key must be known and every value of its type, without a unit
/// behind it, and within its limits. What the version before called otherwise is read, and told in
/// `warnings`. Errors: all faults at once, each with file and line; kNotFound
/// or kIo if the file cannot be read, kInvalidConfig for what is in it.
[[nodiscard]] tl::expected<LoadedConfig, Faults> load_config(const ConfigInput& input);

/// What a source knows of its stereo pair [m] holds, unless the user says otherwise.
void adopt_baseline(const std::optional<double>& baseline_m, LoadedConfig& config);

/// All parameters as a YAML file that load_config() reads back to the same values, bit for bit.
[[nodiscard]] std::string config_to_yaml(const MapperConfig& config);

/// Reads back what config_to_yaml() wrote, as from a map file. `place` is what errors name.
[[nodiscard]] tl::expected<LoadedConfig, Faults> parse_config(const std::string& yaml,
                                                              const std::string& place);

}  // namespace swiftlet
