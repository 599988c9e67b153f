// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/mavlink/links/link_thread.hpp"

namespace swiftlet::test {

/// Keeps what is sent, with the time at which it was, and reads it as an autopilot would.
class RecordingOutlet final : public mavlink::FrameOutlet {
 public:
  struct Sent {
    HostTime at;
    std::size_t link;
    mavlink::Packet packet;
  };

  void send(std::size_t link, const mavlink::WireFrame& frame) override {
    mavlink::PacketParser parser;
    parser.feed(frame.bytes(), {}, [&](const mavlink::Packet& packet) {
      sent_.push_back({now, link, packet});
    });
  }

  /// All messages of a kind since a time.
  template <class Message>
  [[nodiscard]] std::vector<Message> all(HostTime since = {}) const {
    std::vector<Message> messages;
    for (const Sent& sent : sent_) {
      const auto message = sent.packet.as<Message>();
      if (message && sent.at >= since) messages.push_back(*message);
    }
    return messages;
  }
  /// When the first one of a kind was sent at or after a time, or the last one at all.
  template <class Message>
  [[nodiscard]] std::optional<HostTime> first(HostTime since) const {
    for (const Sent& sent : sent_) {
      if (sent.at >= since && sent.packet.as<Message>()) return sent.at;
    }
    return std::nullopt;
  }
  template <class Message>
  [[nodiscard]] std::optional<HostTime> last() const {
    std::optional<HostTime> at;
    for (const Sent& sent : sent_) {
      if (sent.packet.as<Message>()) at = sent.at;
    }
    return at;
  }
  [[nodiscard]] const std::vector<Sent>& sent() const { return sent_; }

  HostTime now{};

 private:
  std::vector<Sent> sent_;
};

}  // namespace swiftlet::test
