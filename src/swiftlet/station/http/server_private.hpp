// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "swiftlet/station/client_protocol.hpp"
#include "swiftlet/station/map_model.hpp"
#include "swiftlet/station/station.hpp"

namespace swiftlet::station {

/// A language that a WebSocket client may ask for by name.
struct Subprotocol {
  std::string_view name;
  std::unique_ptr<ClientProtocol> (*make)(const MapModel& model);
  std::size_t max_message;  ///< from the client [bytes]
  double messages_per_s;    ///< from the client
};
/// The table of them: a protocol is a ClientProtocol and a line there.
[[nodiscard]] std::span<const Subprotocol> subprotocols();

/// What is behind Station::start(): all that needs Boost.
[[nodiscard]] Expected<std::unique_ptr<Station>> start_server(const StationOptions& options,
                                                              MapModel model);

}  // namespace swiftlet::station
