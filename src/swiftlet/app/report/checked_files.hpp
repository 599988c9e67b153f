// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

#include "swiftlet/app/command.hpp"

namespace swiftlet::app {

/// Everything that is wrong with a map, an OctoMap, a recording, a config, a rig or a scene; empty
/// if nothing is. Of the kinds that are YAML, the one whose keys it has.
[[nodiscard]] Faults faults_in_file(const std::string& path);

}  // namespace swiftlet::app
