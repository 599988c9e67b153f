// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <string>

namespace swiftlet::station {

/// A plain request; `more` are lines of its head.
inline std::string get(std::uint16_t port, const std::string& more = "",
                       const std::string& target = "/") {
  return "GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
         "\r\nConnection: close\r\n" + more + "\r\n";
}

/// A request for a WebSocket.
inline std::string upgrade(std::uint16_t port, const std::string& more = "",
                           const std::string& target = "/ws",
                           const std::string& protocol = "swiftlet.v1") {
  return "GET " + target + " HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(port) +
         "\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
         "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n" +
         (protocol.empty() ? "" : "Sec-WebSocket-Protocol: " + protocol + "\r\n") + more + "\r\n";
}

}  // namespace swiftlet::station
