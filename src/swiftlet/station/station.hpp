// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/station/http/access.hpp"
#include "swiftlet/station/http/door.hpp"
#include "swiftlet/station/http/listen_address.hpp"
#include "swiftlet/station/state/live_feed.hpp"
#include "swiftlet/station/state/map_mirror.hpp"
#include "swiftlet/station/state/map_saver.hpp"

namespace swiftlet::station {

struct StationOptions {
  ListenAddress listen;
  /// Without a token the address must be a loopback one.
  AccessRules access;
  std::size_t max_clients = 20;      ///< sockets with data; more are refused
  std::size_t max_connections = 64;  ///< requests being answered, of who may look
  std::size_t max_downloads = 16;    ///< of the map file, among them
  std::size_t max_waiting = 32;      ///< connections of who has not shown yet that he may look
  std::size_t max_download_bytes = std::size_t{64} << 20U;  ///< of map files that are being taken
  std::chrono::milliseconds timeout{3000};  ///< from a connection to the whole of its request
  std::chrono::milliseconds tick{50};       ///< how often the map is polled
  MapSaver save_map;    ///< for who asks for the map as a file; empty: nobody can
  TellOperator tell{};  ///< who was turned away and why, now and then; may be empty
};

/// A saved map, to be shown as it is.
struct SavedWorld {
  MapInfo info;
  MapMirror map;
};

/// The ground station's server: HTTP for the page and WebSocket for the map and what happens, on
/// one port and in one thread of its own with low priority.
///
/// Thread safety: start() and the destructor, which stops it, from one thread. The mapping thread
/// knows the feed alone and never waits for this.
class Station {
 public:
  /// Shows a flight. The feed must outlive the station. Errors: kUsage if it would be open to
  /// others without a token, kIo if the address cannot be listened on, kUnsupported in a build
  /// without it.
  [[nodiscard]] static Expected<std::unique_ptr<Station>> start(const StationOptions& options,
                                                                LiveFeed& feed);
  /// Shows a saved map.
  [[nodiscard]] static Expected<std::unique_ptr<Station>> start(const StationOptions& options,
                                                                SavedWorld saved);
  virtual ~Station() = default;

  /// Where it listens, with the port that was chosen.
  [[nodiscard]] virtual const ListenAddress& address() const = 0;
  /// For people, with the token: "http://127.0.0.1:8080/?token=...". Where it listens everywhere,
  /// each address of the machine that others can open, its name last. Never empty.
  [[nodiscard]] std::vector<std::string> urls() const;

 protected:
  explicit Station(std::string token) : token_(std::move(token)) {}

 private:
  std::string token_;
};

/// Sets the thread that calls it back behind all others.
void run_with_low_priority();

}  // namespace swiftlet::station
