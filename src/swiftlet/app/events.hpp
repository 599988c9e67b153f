// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <vector>

#include "swiftlet/app/progress.hpp"
#include "swiftlet/source/rig_event.hpp"

namespace swiftlet::app {

/// "camera 'front' unplugged: plug it in again"
[[nodiscard]] std::string event_text(const RigEvent& event);

/// Tells of live instruments on standard error, a line each, above the progress.
void tell_events(const std::vector<RigEvent>& events, Progress& progress);

}  // namespace swiftlet::app
