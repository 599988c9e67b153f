// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <CLI/App.hpp>

#include "swiftlet/config/config_file.hpp"

namespace swiftlet::app {

/// Declares --config and --set.
void declare_config_flags(CLI::App& parser, ConfigInput& config);

}  // namespace swiftlet::app
