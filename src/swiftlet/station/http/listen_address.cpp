// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/listen_address.hpp"

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>

#include "swiftlet/base/number_text.hpp"

namespace swiftlet::station {
namespace {

bool is_numeric(const std::string& host) {
  in6_addr scratch{};
  return inet_pton(AF_INET, host.c_str(), &scratch) == 1 ||
         inet_pton(AF_INET6, host.c_str(), &scratch) == 1;
}

}  // namespace

bool ListenAddress::is_everywhere() const {
  in6_addr address{};
  if (inet_pton(AF_INET6, host.c_str(), &address) == 1) return IN6_IS_ADDR_UNSPECIFIED(&address);
  return host == "0.0.0.0";
}

bool ListenAddress::is_loopback() const { return host.starts_with("127.") || host == "::1"; }

std::string ListenAddress::text() const {
  const bool is_v6 = host.find(':') != std::string::npos;
  return is_v6 ? fmt::format("[{}]:{}", host, port) : fmt::format("{}:{}", host, port);
}

Expected<ListenAddress> parse_listen_address(std::string_view text) {
  const auto refuse = [&](std::string what) {
    return fail(ErrorCode::kUsage, fmt::format("--listen {}", text), std::move(what),
                "write ADDRESS:PORT, as in 127.0.0.1:8080 or [::1]:8080");
  };
  std::string_view host = text;
  std::string_view port;
  const auto colon = text.rfind(':');
  const auto bracket = text.rfind(']');
  if (colon != std::string_view::npos && (bracket == std::string_view::npos || colon > bracket)) {
    host = text.substr(0, colon);
    port = text.substr(colon + 1);
    if (port.empty()) return refuse("there is no port behind the colon");
  }
  if (host.starts_with('[') && host.ends_with(']')) host = host.substr(1, host.size() - 2);
  ListenAddress address;
  if (!host.empty()) address.host = host == "localhost" ? "127.0.0.1" : std::string(host);
  if (!is_numeric(address.host)) return refuse("the address is not numeric");
  if (!port.empty()) {
    const auto number = number_from<std::uint16_t>(port);
    if (!number) return refuse("the port is no number from 0 to 65535");
    address.port = *number;
  }
  return address;
}

}  // namespace swiftlet::station
