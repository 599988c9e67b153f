// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/block_map.hpp"

namespace swiftlet::station {

/// Makes the map file of a map, as bytes; its header counts no frames if it is a saved one. Called
/// in a thread of its own, one call at a time.
using MapSaver = std::function<Expected<std::vector<std::uint8_t>>(const BlockMap&)>;
using SharedBytes = std::shared_ptr<const std::vector<std::uint8_t>>;

}  // namespace swiftlet::station
