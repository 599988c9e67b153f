// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/view/flight_watch.hpp"

#include "swiftlet/app/view/map_saver.hpp"

namespace swiftlet::app {

Expected<std::unique_ptr<FlightWatch>> FlightWatch::start(const StationFlags& flags,
                                                          std::string source, MapMeta meta) {
  auto options = station_options(flags);
  if (!options) return forward_error(std::move(options));
  options->save_map = map_saver(std::move(meta));
  std::unique_ptr<FlightWatch> watch(new FlightWatch(std::move(source)));
  auto station = station::Station::start(*options, watch->feed());
  if (!station) return forward_error(std::move(station));
  watch->station_ = std::move(*station);
  return watch;
}

}  // namespace swiftlet::app
