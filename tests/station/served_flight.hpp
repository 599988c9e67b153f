// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <string>

#include "station/raw_socket.hpp"
#include "station/station_world.hpp"
#include "swiftlet/station/station.hpp"

namespace swiftlet::station {

/// A flight, and a station that shows it on a port of its own.
class ServedFlight : public ::testing::Test {
 protected:
  void serve(StationOptions options) {
    options.listen.port = 0;
    options.tick = std::chrono::milliseconds(5);
    auto station = Station::start(options, flight_.feed);
    ASSERT_TRUE(station) << station.error().text();
    station_ = std::move(*station);
    port_ = station_->address().port;
  }
  [[nodiscard]] std::string answer_to(const std::string& bytes) const {
    RawSocket socket(port_);
    socket.send(bytes);
    return socket.receive_all();
  }

  test::Random random_;
  RandomFlight flight_{random_};
  std::unique_ptr<Station> station_;
  std::uint16_t port_ = 0;
};

}  // namespace swiftlet::station
