// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/station/state/map_saver.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet::app {

/// What makes the map files that clients of the ground station ask for. `meta` describes the map,
/// as in the file of the flight. Errors of what it returns: kIo.
[[nodiscard]] station::MapSaver map_saver(MapMeta meta);

}  // namespace swiftlet::app
