// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <array>

#include "swiftlet/station/client_message.hpp"
#include "swiftlet/station/server_private.hpp"

namespace swiftlet::station {

std::span<const Subprotocol> subprotocols() {
  static constexpr std::array kTable{
      Subprotocol{kSubprotocol, make_page_viewer, kMaxClientMessage, 20.0},
  };
  return kTable;
}

}  // namespace swiftlet::station
