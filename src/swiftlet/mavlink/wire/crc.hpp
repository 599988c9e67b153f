// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <span>

namespace swiftlet::mavlink {

/// Adds bytes to the checksum of a frame: CRC-16/MCRF4XX (X.25 without its last inversion), which
/// starts at kCrcStart. Source: MAVLink 2, "Packet Serialization".
inline constexpr std::uint16_t kCrcStart = 0xFFFF;

[[nodiscard]] constexpr std::uint16_t crc_with(std::uint16_t crc, std::uint8_t byte) {
  auto mixed = static_cast<std::uint8_t>(byte ^ (crc & 0xFFU));
  mixed = static_cast<std::uint8_t>(mixed ^ (mixed << 4U));
  return static_cast<std::uint16_t>((crc >> 8U) ^ (mixed << 8U) ^ (mixed << 3U) ^ (mixed >> 4U));
}

[[nodiscard]] constexpr std::uint16_t crc_with(std::uint16_t crc,
                                               std::span<const std::uint8_t> bytes) {
  for (const std::uint8_t byte : bytes) crc = crc_with(crc, byte);
  return crc;
}

}  // namespace swiftlet::mavlink
