// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <memory>
#include <string>
#include <vector>

#include "swiftlet/mavlink/companion/companion.hpp"
#include "swiftlet/mavlink/companion/flight_news.hpp"
#include "swiftlet/mavlink/links/link_thread.hpp"

namespace swiftlet::mavlink {

struct AutopilotOptions {
  LinkOptions links;
  CompanionOptions companion;  ///< its `links` and `key` are those of the links
};

/// The autopilot's side of a flight: a companion and its links, in a thread of their own. The
/// mapping thread knows the news alone and never waits for it.
/// Thread safety: start() and the destructor from one thread, report() and take_notes() from any.
class Autopilot {
 public:
  /// Errors: those of LinkThread::start().
  [[nodiscard]] static Expected<std::unique_ptr<Autopilot>> start(AutopilotOptions options);
  virtual ~Autopilot() = default;

  /// What the flight tells; lives as long as this.
  [[nodiscard]] virtual FlightNews& news() = 0;
  /// As of the last tick.
  [[nodiscard]] virtual CompanionReport report() const = 0;
  [[nodiscard]] virtual LinkTally tally(std::size_t link) const = 0;
  /// What has happened to links and vehicle since the last call, a sentence each.
  [[nodiscard]] virtual std::vector<std::string> take_notes() = 0;
};

/// "PX4, system 1, armed, mode 65536", for people.
[[nodiscard]] std::string text_of(const VehicleState& vehicle);

}  // namespace swiftlet::mavlink
