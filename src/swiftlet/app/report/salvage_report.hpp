// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <nlohmann/json_fwd.hpp>

#include "swiftlet/store/map_file/salvage.hpp"

namespace swiftlet::app {

/// For machines: what of a damaged map was kept, what is missing, and the same in words.
[[nodiscard]] nlohmann::ordered_json salvage_json(const SalvageReport& report);

}  // namespace swiftlet::app
