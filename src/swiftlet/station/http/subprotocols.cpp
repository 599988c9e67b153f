// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <array>

#include "swiftlet/station/http/server_private.hpp"
#include "swiftlet/station/page/client_message.hpp"

namespace swiftlet::station {
namespace {

constexpr std::size_t kMaxFoxgloveMessage = std::size_t{16} * 1024;  // names of channels, as JSON

}  // namespace

std::span<const Subprotocol> subprotocols() {
  static constexpr std::array kTable{
      Subprotocol{kSubprotocol, make_page_protocol, kMaxClientMessage, 20.0},
      // One protocol under its new and its old name.
      Subprotocol{"foxglove.sdk.v1", make_foxglove_protocol, kMaxFoxgloveMessage, 100.0},
      Subprotocol{"foxglove.websocket.v1", make_foxglove_protocol, kMaxFoxgloveMessage, 100.0},
  };
  return kTable;
}

}  // namespace swiftlet::station
