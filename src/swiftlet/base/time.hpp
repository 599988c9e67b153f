// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <chrono>
#include <compare>
#include <cstdint>
#include <string_view>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// A duration.
using Nanoseconds = std::chrono::nanoseconds;

/// A point in time: nanoseconds of the source's own clock. Never a double of seconds, which loses
/// nanoseconds at today's epoch.
struct Stamp {
  std::int64_t ns = 0;  ///< since the clock's own zero

  friend constexpr auto operator<=>(Stamp, Stamp) = default;
  /// What lies between two stamps.
  friend constexpr Nanoseconds operator-(Stamp a, Stamp b) { return Nanoseconds(a.ns - b.ns); }
  /// Later by a duration.
  friend constexpr Stamp operator+(Stamp a, Nanoseconds d) { return {a.ns + d.count()}; }
  /// Earlier by a duration.
  friend constexpr Stamp operator-(Stamp a, Nanoseconds d) { return {a.ns - d.count()}; }
};

/// Seconds between two stamps, for arithmetic and display; never to be stored as a time.
[[nodiscard]] constexpr double seconds(Nanoseconds d) {
  return static_cast<double>(d.count()) * 1e-9;
}

/// Whose clock a stamp was read from. Stamps of different clocks cannot be compared.
enum class ClockDomain : std::uint8_t {
  kUnspecified,  ///< the source does not tell: taken to be the clock of whatever it is joined with
  kGlobal,       ///< the device's clock, translated to that of the host (RealSense "Global Time")
  kSystem,       ///< the host's clock at arrival, late by exposure and transfer
  kDevice,       ///< the device's own, from its power-on: no other device shares it
};
/// For people, by ClockDomain.
inline constexpr std::array<std::string_view, 4> kClockDomainNames{
    "unspecified clock", "global time", "system time", "the device's own clock"};

/// For people.
[[nodiscard]] constexpr std::string_view name_of(ClockDomain clock) {
  return kClockDomainNames[static_cast<std::size_t>(clock)];
}

/// Whether stamps of two devices can be compared.
[[nodiscard]] constexpr bool is_same_clock(ClockDomain a, ClockDomain b) {
  if (a == ClockDomain::kUnspecified || b == ClockDomain::kUnspecified) return true;
  return a == b && a != ClockDomain::kDevice;
}

/// Reads "1305031102.175304" exactly (digits beyond nanoseconds are dropped), without passing
/// through a double. Errors: kCorruptInput if the text is no decimal number of seconds or lies
/// outside the range of int64 nanoseconds.
[[nodiscard]] Expected<Stamp> parse_stamp(std::string_view text);

}  // namespace swiftlet
