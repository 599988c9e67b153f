// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/reachable.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>

namespace swiftlet::station {
namespace {

/// Empty for what no browser on another machine can open.
std::string numeric_address(const ifaddrs& interface) {
  const bool is_up = (interface.ifa_flags & IFF_UP) != 0;
  if (!is_up || (interface.ifa_flags & IFF_LOOPBACK) != 0 || interface.ifa_addr == nullptr) {
    return {};
  }
  std::array<char, INET6_ADDRSTRLEN> text{};
  const void* bytes = nullptr;
  if (interface.ifa_addr->sa_family == AF_INET) {
    bytes = &reinterpret_cast<const sockaddr_in*>(interface.ifa_addr)->sin_addr;
  } else if (interface.ifa_addr->sa_family == AF_INET6) {
    const auto& address = reinterpret_cast<const sockaddr_in6*>(interface.ifa_addr)->sin6_addr;
    if (IN6_IS_ADDR_LINKLOCAL(&address)) return {};  // means nothing without the interface's name
    bytes = &address;
  }
  if (bytes == nullptr) return {};
  return inet_ntop(interface.ifa_addr->sa_family, bytes, text.data(), text.size());
}

std::string machine_name() {
  std::array<char, 256> text{};
  if (gethostname(text.data(), text.size() - 1) != 0) return {};
  std::string name(text.data());
  const bool is_good = std::ranges::all_of(
      name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '-' || c == '.'; });
  return is_good && !name.starts_with("localhost") ? name : std::string{};
}

}  // namespace

OwnAddresses own_addresses() {
  OwnAddresses own{{}, machine_name()};
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return own;
  const std::unique_ptr<ifaddrs, decltype(&freeifaddrs)> all(first, freeifaddrs);
  for (const ifaddrs* one = first; one != nullptr; one = one->ifa_next) {
    std::string text = numeric_address(*one);
    if (!text.empty() && std::ranges::find(own.numeric, text) == own.numeric.end()) {
      own.numeric.push_back(std::move(text));
    }
  }
  return own;
}

std::vector<ListenAddress> reachable_at(const ListenAddress& listen, const OwnAddresses& own) {
  if (!listen.is_everywhere()) return {listen};
  std::vector<ListenAddress> places;
  for (const std::string& host : own.numeric) {
    const bool is_v6 = host.find(':') != std::string::npos;
    if (is_v6 && listen.host == "0.0.0.0") continue;
    places.push_back({host, listen.port});
  }
  if (!own.name.empty()) places.push_back({own.name, listen.port});
  // Off every network the machine itself is still a place to look from.
  if (places.empty()) places.push_back({"127.0.0.1", listen.port});
  return places;
}

}  // namespace swiftlet::station
