// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/time.hpp"

#include <charconv>
#include <string>

namespace swiftlet {
namespace {

constexpr std::int64_t kNanosecondsPerSecond = 1'000'000'000;
constexpr std::int64_t kMaxSeconds = 9'000'000'000;  // int64 nanoseconds end near 9.22e9 s
constexpr std::size_t kFractionDigits = 9;

bool all_digits(std::string_view text) {
  return text.find_first_not_of("0123456789") == std::string_view::npos;
}

std::int64_t whole_number(std::string_view digits, bool& ok) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  ok = ok && error == std::errc{} && end == digits.data() + digits.size();
  return value;
}

}  // namespace

Expected<Stamp> parse_stamp(std::string_view text) {
  const bool negative = text.starts_with('-');
  const std::string_view magnitude = negative ? text.substr(1) : text;
  const std::size_t point = magnitude.find('.');
  const std::string_view whole = magnitude.substr(0, point);
  std::string fraction(point == std::string_view::npos ? std::string_view{}
                                                       : magnitude.substr(point + 1));

  bool ok = !whole.empty() && all_digits(whole) && all_digits(fraction);
  fraction.resize(kFractionDigits, '0');
  const std::int64_t s = ok ? whole_number(whole, ok) : 0;
  const std::int64_t ns = ok ? whole_number(fraction, ok) : 0;
  if (!ok || s > kMaxSeconds) {
    return fail(ErrorCode::kCorruptInput, {},
                "'" + std::string(text) + "' is not a time in seconds");
  }
  const std::int64_t total = s * kNanosecondsPerSecond + ns;
  return Stamp{negative ? -total : total};
}

}  // namespace swiftlet
