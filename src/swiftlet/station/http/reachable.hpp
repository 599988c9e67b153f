// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <vector>

#include "swiftlet/station/http/listen_address.hpp"

namespace swiftlet::station {

/// What this machine is called and where it can be reached from others.
struct OwnAddresses {
  std::vector<std::string> numeric;  ///< of interfaces that are up; neither loopback nor link-local
  std::string name;                  ///< empty if it has none
};
[[nodiscard]] OwnAddresses own_addresses();

/// Addresses that can be written into a browser to reach a server that listens there: itself, or,
/// where it listens everywhere (0.0.0.0, ::), each of the machine's own and its name. Never empty.
[[nodiscard]] std::vector<ListenAddress> reachable_at(const ListenAddress& listen,
                                                      const OwnAddresses& own);

}  // namespace swiftlet::station
