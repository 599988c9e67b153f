// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace swiftlet {

/// The number that a text is, all of it, whatever the locale; nullopt for anything before, behind
/// or out of range.
template <class Number>
[[nodiscard]] std::optional<Number> number_from(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || stop != end) return std::nullopt;
  return value;
}

}  // namespace swiftlet
