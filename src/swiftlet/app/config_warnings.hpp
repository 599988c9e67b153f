// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

#include "swiftlet/config/config_file.hpp"

namespace swiftlet::app {

/// Tells on standard error what of the user's config works for one more version only.
void tell_warnings(const LoadedConfig& config);

/// Tells of a flag or name that has another one now.
void tell_renamed(const std::string& place, const std::string& before, const std::string& now);

/// The measurement model that a flag names, by its name of today; one of yesterday is told. `place`
/// is the flag.
[[nodiscard]] std::string current_model(const std::string& name, const std::string& place);

}  // namespace swiftlet::app
