// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace swiftlet {

/// What becomes of a frame whose poses began a new world (Frame::pose_epoch), of which the map
/// knows nothing.
enum class NewWorldRule : std::uint8_t {
  kRefuse,  ///< it is refused until the owner calls Mapper::begin_world()
  kClear,   ///< the map is cleared and begun anew with it
  kKeep,    ///< it is fused into the map as if nothing had happened
};

/// In config files, by NewWorldRule.
inline constexpr std::array<std::string_view, 3> kNewWorldRuleNames{"refuse", "clear", "keep"};

/// The name in config files. REQUIRES: one of the three.
[[nodiscard]] constexpr std::string_view name_of(NewWorldRule rule) {
  return kNewWorldRuleNames[static_cast<std::size_t>(rule)];
}

/// The rule of a name; nullopt if there is none.
[[nodiscard]] constexpr std::optional<NewWorldRule> new_world_rule(std::string_view name) {
  const auto* const found = std::ranges::find(kNewWorldRuleNames, name);
  if (found == kNewWorldRuleNames.end()) return std::nullopt;
  return static_cast<NewWorldRule>(found - kNewWorldRuleNames.begin());
}

}  // namespace swiftlet
