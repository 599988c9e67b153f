// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/links/link_address.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "swiftlet/base/number_text.hpp"

namespace swiftlet::mavlink {
namespace {

constexpr unsigned kLeastBaud = 1200, kMostBaud = 12'000'000;

/// A numeric address, as it is opened; nullopt for anything else.
std::optional<std::string> host_from(std::string_view text) {
  if (text == "localhost") return "127.0.0.1";
  const bool is_v6 = text.starts_with('[') && text.ends_with(']') && text.size() > 2;
  std::string host(is_v6 ? text.substr(1, text.size() - 2) : text);
  in6_addr scratch{};
  if (inet_pton(is_v6 ? AF_INET6 : AF_INET, host.c_str(), &scratch) != 1) return std::nullopt;
  return host;
}

std::string bracketed(const std::string& host) {
  return host.find(':') == std::string::npos ? host : "[" + host + "]";
}

/// Reads "HOST:PORT"; what is wrong with it.
std::optional<std::string> read_place(std::string_view text, LinkAddress& address) {
  const std::size_t colon = text.rfind(':');
  if (colon == std::string_view::npos) return "there is no port";
  const auto host = host_from(text.substr(0, colon));
  if (!host) return "the host is no numeric address";
  const auto port = number_from<std::uint16_t>(text.substr(colon + 1));
  if (!port || *port == 0) return "the port is no number from 1 to 65535";
  address.host = *host;
  address.port = *port;
  return std::nullopt;
}

std::optional<std::string> read_option(std::string_view option, LinkAddress& address) {
  constexpr std::string_view kPeer = "peer=", kBaud = "baud=";
  if (address.kind == LinkKind::kUdpListen && option.starts_with(kPeer)) {
    const auto peer = host_from(option.substr(kPeer.size()));
    if (!peer) return "the peer is no numeric address";
    address.peer = *peer;
    return std::nullopt;
  }
  if (address.kind == LinkKind::kSerial && option.starts_with(kBaud)) {
    const auto baud = number_from<unsigned>(option.substr(kBaud.size()));
    if (!baud || *baud < kLeastBaud || *baud > kMostBaud)
      return fmt::format("the rate is no number from {} to {}", kLeastBaud, kMostBaud);
    address.baud = *baud;
    return std::nullopt;
  }
  return fmt::format("'{}' is no option of it", option);
}

std::optional<std::string> read_parts(std::string_view rest, LinkAddress& address) {
  const std::size_t mark = std::min(rest.find('?'), rest.size());
  const std::string_view place = rest.substr(0, mark);
  if (address.kind != LinkKind::kSerial) {
    if (auto fault = read_place(place, address)) return fault;
  } else if (place.empty() || place.find('\0') != std::string_view::npos) {
    return "there is no device";
  } else {
    address.device = place;
  }
  if (mark == rest.size()) return std::nullopt;
  return read_option(rest.substr(mark + 1), address);
}

}  // namespace

bool LinkAddress::is_loopback() const { return host.starts_with("127.") || host == "::1"; }

bool LinkAddress::has_known_peer() const {
  return kind != LinkKind::kUdpListen || is_loopback() || !peer.empty();
}

std::string LinkAddress::text() const {
  const std::string_view name = kLinkKindNames[static_cast<std::size_t>(kind)];
  if (kind == LinkKind::kSerial) return fmt::format("{}:{}?baud={}", name, device, baud);
  const std::string from = peer.empty() ? "" : "?peer=" + bracketed(peer);
  return fmt::format("{}:{}:{}{}", name, bracketed(host), port, from);
}

Expected<LinkAddress> parse_link_address(std::string_view text) {
  const auto refuse = [&](std::string what) {
    return fail(ErrorCode::kUsage, fmt::format("--mavlink {}", text), std::move(what),
                "write udp:HOST:PORT, udpin:HOST:PORT, tcp:HOST:PORT or serial:/dev/ttyACM0");
  };
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto* const name = std::ranges::find(kLinkKindNames, text.substr(0, colon));
  if (name == kLinkKindNames.end()) return refuse("no such kind of link");
  LinkAddress address;
  address.kind = static_cast<LinkKind>(name - kLinkKindNames.begin());
  if (auto fault = read_parts(text.substr(std::min(colon + 1, text.size())), address))
    return refuse(std::move(*fault));
  return address;
}

}  // namespace swiftlet::mavlink
