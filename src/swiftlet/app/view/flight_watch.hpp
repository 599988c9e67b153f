// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <memory>
#include <string>
#include <utility>

#include "swiftlet/app/view/station_flags.hpp"
#include "swiftlet/station/flight/flight_feed.hpp"
#include "swiftlet/station/station.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet::app {

/// Shows a flight in the ground station while it goes on.
class FlightWatch final : public station::FlightFeed {
 public:
  /// Starts to serve; `meta` as in the map file. Errors: kUsage, kIo, kUnsupported (see
  /// Station::start()).
  [[nodiscard]] static Expected<std::unique_ptr<FlightWatch>> start(const StationFlags& flags,
                                                                    std::string source,
                                                                    MapMeta meta);

  [[nodiscard]] const station::Station& station() const { return *station_; }

 private:
  explicit FlightWatch(std::string source) : station::FlightFeed(std::move(source)) {}

  std::unique_ptr<station::Station> station_;  // goes before the feed, which it reads
};

}  // namespace swiftlet::app
