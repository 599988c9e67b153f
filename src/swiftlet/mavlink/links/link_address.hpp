// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"

namespace swiftlet::mavlink {

enum class LinkKind : std::uint8_t {
  kUdp,        ///< to a host and port; answers come from there
  kUdpListen,  ///< at a port; whoever speaks first is the peer
  kTcp,        ///< to a host and port
  kSerial,     ///< a device, 8N1
};
inline constexpr std::array<std::string_view, 4> kLinkKindNames{"udp", "udpin", "tcp", "serial"};

/// Where an autopilot is reached.
struct LinkAddress {
  LinkKind kind = LinkKind::kUdp;
  std::string host{};  ///< numeric; of the interface that listens for kUdpListen
  std::uint16_t port = 0;
  std::string peer{};       ///< kUdpListen: the one address that is heard; empty: of any
  std::string device{};     ///< kSerial
  unsigned baud = 921'600;  ///< kSerial

  /// Only this computer reaches it.
  [[nodiscard]] bool is_loopback() const;
  /// Whether who is heard is known beforehand: this computer, a named one, or a cable.
  [[nodiscard]] bool has_known_peer() const;
  /// As it was written: "udp:127.0.0.1:14540".
  [[nodiscard]] std::string text() const;

  friend bool operator==(const LinkAddress&, const LinkAddress&) = default;
};

/// Reads "udp:HOST:PORT", "udpin:HOST:PORT" (also "udpin:HOST:PORT?peer=HOST"), "tcp:HOST:PORT" or
/// "serial:DEVICE" (also "serial:DEVICE?baud=57600"). Hosts are numeric, so that nothing is looked
/// up, or "localhost"; one of IPv6 stands in brackets. Errors: kUsage.
[[nodiscard]] Expected<LinkAddress> parse_link_address(std::string_view text);

}  // namespace swiftlet::mavlink
