// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <string>

#include "swiftlet/session/mapping_summary.hpp"

namespace swiftlet::app {

/// For people, several lines.
[[nodiscard]] std::string summary_text(const MappingSummary& summary);
/// For machines, one JSON object. Times in ms, sizes in bytes.
[[nodiscard]] std::string summary_json(const MappingSummary& summary);

/// "3.2 MB"
[[nodiscard]] std::string size_text(std::uintmax_t bytes);

}  // namespace swiftlet::app
