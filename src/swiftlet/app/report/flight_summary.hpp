// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

#include "swiftlet/fly/flight_report.hpp"

namespace swiftlet::app {

/// For people, several lines.
[[nodiscard]] std::string flight_text(const FlightReport& report);
/// For machines, one JSON object.
[[nodiscard]] std::string flight_json(const FlightReport& report);
/// Where it flew: a line of x, y, z [m] every tenth of a second, below their names.
[[nodiscard]] std::string track_csv(const FlightReport& report);

}  // namespace swiftlet::app
