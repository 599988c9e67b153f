// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "swiftlet/mavlink/wire/message_layout.hpp"

// What vehicles and companions tell of themselves. Source of names, numbers and order: the public
// dialects minimal.xml, common.xml.

namespace swiftlet::mavlink {

/// Who is there and how it is, once a second.
struct Heartbeat {
  static constexpr std::string_view kName = "HEARTBEAT";
  static constexpr std::uint32_t kId = 0;
  std::uint32_t custom_mode = 0;     ///< the flight mode, in the autopilot's own numbers
  std::uint8_t type = 0;             ///< MAV_TYPE
  std::uint8_t autopilot = 0;        ///< MAV_AUTOPILOT
  std::uint8_t base_mode = 0;        ///< MAV_MODE_FLAG
  std::uint8_t system_status = 0;    ///< MAV_STATE
  std::uint8_t mavlink_version = 3;  ///< 3 stands for MAVLink 2, too
  [[nodiscard]] static constexpr auto fields() {
    return std::tuple(base("custom_mode", &Heartbeat::custom_mode), base("type", &Heartbeat::type),
                      base("autopilot", &Heartbeat::autopilot),
                      base("base_mode", &Heartbeat::base_mode),
                      base("system_status", &Heartbeat::system_status),
                      base("mavlink_version", &Heartbeat::mavlink_version));
  }
};

/// The sender's clocks.
struct SystemTime {
  static constexpr std::string_view kName = "SYSTEM_TIME";
  static constexpr std::uint32_t kId = 2;
  std::uint64_t time_unix_usec = 0;
  std::uint32_t time_boot_ms = 0;
  [[nodiscard]] static constexpr auto fields() {
    return std::tuple(base("time_unix_usec", &SystemTime::time_unix_usec),
                      base("time_boot_ms", &SystemTime::time_boot_ms));
  }
};

/// A question for the other's clock, or the answer to one (see ClockOffset).
struct Timesync {
  static constexpr std::string_view kName = "TIMESYNC";
  static constexpr std::uint32_t kId = 111;
  std::int64_t tc1 = 0;  ///< of whoever answers [ns]; 0 in a question
  std::int64_t ts1 = 0;  ///< of whoever asks [ns]
  std::uint8_t target_system = 0;
  std::uint8_t target_component = 0;
  [[nodiscard]] static constexpr auto fields() {
    return std::tuple(base("tc1", &Timesync::tc1), base("ts1", &Timesync::ts1),
                      extension("target_system", &Timesync::target_system),
                      extension("target_component", &Timesync::target_component));
  }
};

/// A sentence for the pilot; without a zero at its end if it fills the field.
struct StatusText {
  static constexpr std::string_view kName = "STATUSTEXT";
  static constexpr std::uint32_t kId = 253;
  std::uint8_t severity = 6;  ///< MAV_SEVERITY: 0 emergency to 7 debug
  std::array<char, 50> text{};
  std::uint16_t id = 0;        ///< of a text in several pieces; 0 if it is whole
  std::uint8_t chunk_seq = 0;  ///< which piece
  [[nodiscard]] static constexpr auto fields() {
    return std::tuple(base("severity", &StatusText::severity), base("text", &StatusText::text),
                      extension("id", &StatusText::id),
                      extension("chunk_seq", &StatusText::chunk_seq));
  }
};

}  // namespace swiftlet::mavlink
