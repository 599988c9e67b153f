// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"

namespace swiftlet::station {

/// Where a server listens: a numeric address, so that nothing is looked up.
struct ListenAddress {
  std::string host = "127.0.0.1";
  std::uint16_t port = 8080;  ///< 0: the system chooses

  /// "0.0.0.0" or "::", which are no addresses to open but stand for all of the machine's.
  [[nodiscard]] bool is_everywhere() const;
  /// Only this machine can reach it.
  [[nodiscard]] bool is_loopback() const;
  /// "127.0.0.1:8080", "[::1]:8080"
  [[nodiscard]] std::string text() const;
};

/// Reads "127.0.0.1:8080", "[::1]:0", "localhost:80", "0.0.0.0" (with the default port) or ":9000".
/// Errors: kUsage.
[[nodiscard]] Expected<ListenAddress> parse_listen_address(std::string_view text);

}  // namespace swiftlet::station
