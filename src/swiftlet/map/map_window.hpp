// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/map/block_map.hpp"
#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet {

/// A whole map as a planner asks it: a window that holds all of it. Errors: kNotFound if it holds
/// nothing; kUnsupported if it is too wide for one; kOutOfMemory.
[[nodiscard]] Expected<RollingMap> window_of(const BlockMap& map);

}  // namespace swiftlet
