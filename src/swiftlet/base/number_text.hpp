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

/// A decimal number in any notation, also with a plus, "nan" and "inf"; nullopt unless the whole
/// word is one.
[[nodiscard]] inline std::optional<double> parse_number(std::string_view word) {
  // from_chars knows only the minus; "+-1" stays no number.
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  return number_from<double>(word);
}

}  // namespace swiftlet
