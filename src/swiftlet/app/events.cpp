// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/events.hpp"

#include <algorithm>

namespace swiftlet::app {

std::string event_text(const RigEvent& event) {
  std::string kind(name_of(event.kind));
  std::ranges::replace(kind, '_', ' ');
  const std::string text = event.who + " " + kind;
  return event.what.empty() ? text : text + ": " + event.what;
}

void tell_events(const std::vector<RigEvent>& events, Progress& progress) {
  for (const RigEvent& event : events) progress.tell(event_text(event));
}

}  // namespace swiftlet::app
