// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "swiftlet/app/interrupt.hpp"
#include "swiftlet/station/station.hpp"

namespace swiftlet::app {

/// What a user may say of the ground station's server.
struct StationFlags {
  std::string listen = "127.0.0.1:8080";
  std::string token;
  std::vector<std::string> origins;
};

/// Declares --listen, --token and --origin.
void declare_station_flags(CLI::App& parser, StationFlags& flags);

/// With a token made up where others can reach the address and the user gave none.
/// Errors: kUsage.
[[nodiscard]] Expected<station::StationOptions> station_options(const StationFlags& flags);

/// Tells on standard error where to look.
void tell_address(const station::Station& station);

/// Returns when the user has asked to stop.
void wait_for(const InterruptGuard& interrupt);

}  // namespace swiftlet::app
