// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "swiftlet/base/expected.hpp"

namespace swiftlet::station {

/// What a client of `swiftlet.v1` may say (docs/formats/station_wire.md).
struct Resend {
  std::uint32_t first = 0;  ///< sequence numbers that it has missed
  std::uint32_t last = 0;
};
struct SendAll {};  ///< its digest is wrong, or it lost count
enum class Pace : std::uint8_t { kFlow = 0, kHold = 1, kStep = 2 };
struct SetPace {
  Pace pace = Pace::kFlow;
};
struct SetRate {
  std::uint32_t bytes_per_s = 0;  ///< 0: no limit
};
using ClientMessage = std::variant<Resend, SendAll, SetPace, SetRate>;

/// The longest of them; a server need not read on [bytes].
inline constexpr std::size_t kMaxClientMessage = 12;

/// Errors: kCorruptInput for every other length, type or value.
[[nodiscard]] Expected<ClientMessage> parse_client_message(std::span<const std::uint8_t> bytes);

}  // namespace swiftlet::station
