// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "swiftlet/mavlink/wire/message_layout.hpp"

namespace swiftlet::mavlink {

/// Who sends: the vehicle (system) and which part of it (component).
struct Address {
  std::uint8_t system = 1;
  std::uint8_t component = 0;
  friend constexpr auto operator<=>(const Address&, const Address&) = default;
};

/// The frame on the wire, MAVLink 2:
///
///     FD length flags flags seq system component id[3] payload[length] crc[2] (signature[13])
///
/// The checksum is over all between FD and itself, and over the message's CRC_EXTRA.
namespace wire {
inline constexpr std::uint8_t kStart = 0xFD;
inline constexpr std::uint8_t kIsSigned = 0x01;  ///< the one flag that must be understood and is
inline constexpr std::size_t kHeaderBytes = 10;
inline constexpr std::size_t kCrcBytes = 2;
inline constexpr std::size_t kSignatureBytes = 13;
inline constexpr std::size_t kMaxFrameBytes =
    kHeaderBytes + kMaxPayload + kCrcBytes + kSignatureBytes;
// Offsets in the header.
inline constexpr std::size_t kLength = 1, kMustUnderstand = 2, kMayIgnore = 3, kSequence = 4,
                             kSystem = 5, kComponent = 6, kId = 7;
}  // namespace wire

/// A frame that has come whole and unharmed.
struct Packet {
  Address from{};
  std::uint8_t sequence = 0;
  std::uint32_t id = 0;
  bool is_signed = false;  ///< by our key; never true without one
  Payload payload{};

  /// The message, if it is of this kind.
  template <MessageType Message>
  [[nodiscard]] std::optional<Message> as() const {
    if (id != Message::kId) return std::nullopt;
    return unpack<Message>(payload);
  }
};

}  // namespace swiftlet::mavlink
