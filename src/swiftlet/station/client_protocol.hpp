// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "swiftlet/station/map_model.hpp"

namespace swiftlet::station {

/// A message on its way to a client.
struct Outgoing {
  bool is_text = false;
  Bytes data;
};

/// One client, whatever it speaks: decides what it is sent next. Holds no socket.
/// Thread safety: the station's thread alone.
class ClientProtocol {
 public:
  using Time = std::chrono::steady_clock::time_point;
  virtual ~ClientProtocol() = default;

  /// The station has looked.
  virtual void saw(const MapModel::Update& update) = 0;
  /// The next message, asked for when the one before has left; nullopt: nothing for now.
  [[nodiscard]] virtual std::optional<Outgoing> next(Time now) = 0;
  /// The client has said something. Errors: kCorruptInput, after which it is sent away.
  [[nodiscard]] virtual Status received(bool is_text, std::span<const std::uint8_t> bytes,
                                        Time now) = 0;
  /// How many clients there are.
  virtual void count(std::uint32_t clients) = 0;
  /// Whether it shows depth images, which are fetched for those alone who do.
  [[nodiscard]] virtual bool wants_depth() const { return false; }
};

/// A client of our own page's protocol. `model` must outlive it.
[[nodiscard]] std::unique_ptr<ClientProtocol> make_page_protocol(const MapModel& model);
/// A client of the Foxglove WebSocket protocol: Foxglove, Lichtblick.
[[nodiscard]] std::unique_ptr<ClientProtocol> make_foxglove_protocol(const MapModel& model);

}  // namespace swiftlet::station
