// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "swiftlet/base/time.hpp"
#include "swiftlet/mavlink/wire/messages.hpp"
#include "swiftlet/mavlink/wire/packet.hpp"
#include "swiftlet/mavlink/wire/signer.hpp"

namespace swiftlet::mavlink {

/// One frame's bytes.
class WireFrame {
 public:
  [[nodiscard]] std::span<const std::uint8_t> bytes() const { return {bytes_.data(), size_}; }

 private:
  friend class PacketWriter;
  std::array<std::uint8_t, wire::kMaxFrameBytes> bytes_{};
  std::size_t size_ = 0;
};

/// Frames messages under one address, numbered in order, and signs them if it has a key. Thread
/// safety: none, one owner. Cost: no allocation without a key.
class PacketWriter {
 public:
  explicit PacketWriter(Address from, std::optional<Signer> signer = std::nullopt)
      : from_(from), signer_(std::move(signer)) {}

  /// Frames from now on come from this address.
  void speak_as(Address from) { from_ = from; }

  /// `now` is Unix time; a frame that is not signed does not tell it.
  template <MessageType Message>
  [[nodiscard]] WireFrame write(const Message& message, Stamp now) {
    Payload payload{};
    const std::size_t length = pack(message, payload);
    return frame(Message::kId, crc_extra_of<Message>(), {payload.data(), length}, now);
  }

 private:
  [[nodiscard]] WireFrame frame(std::uint32_t id, std::uint8_t crc_extra,
                                std::span<const std::uint8_t> payload, Stamp now);

  Address from_;
  std::optional<Signer> signer_;
  std::uint8_t sequence_ = 0;
};

}  // namespace swiftlet::mavlink
