// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string_view>

#include "swiftlet/bag/byte_cursor.hpp"
#include "swiftlet/bag/messages/serialized_message.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// Reads the fields of a message one after the other, whether ROS 1 or ROS 2 wrote them, so that
/// one parser serves both. Nothing is trusted: once a read has gone beyond the end, the cursor
/// stays broken and every value is 0 or empty. Source: OMG DDS-XTypes 1.3, 7.4.3 (CDR);
/// wiki.ros.org/msg (ROS 1).
class MessageCursor {
 public:
  explicit MessageCursor(const SerializedMessage& message) : cursor_(message.bytes) {
    if (message.encoding == MessageEncoding::kCdr) {
      read_cdr_header();
    } else if (message.encoding != MessageEncoding::kRos1) {
      break_off();
    }
    body_bytes_ = cursor_.left();
  }

  [[nodiscard]] bool is_good() const { return cursor_.is_good(); }
  [[nodiscard]] std::size_t left() const { return cursor_.left(); }
  [[nodiscard]] bool is_ros1() const { return most_alignment_ == 1; }
  /// Whether the bytes were exactly the fields that were read. Middleware may pad CDR behind them.
  [[nodiscard]] bool is_whole() const {
    return is_good() && left() < (is_ros1() ? 1 : kMostPadding);
  }

  template <class Value>
  Value read() {
    align(sizeof(Value));
    if (!is_big_endian_) return cursor_.read<Value>();
    std::array<std::byte, sizeof(Value)> raw{};
    std::ranges::copy(cursor_.take(sizeof(Value)), raw.begin());
    std::ranges::reverse(raw);
    return std::bit_cast<Value>(raw);
  }
  template <class Value, std::size_t N>
  std::array<Value, N> read_array() {
    std::array<Value, N> values{};
    for (Value& value : values) value = read<Value>();
    return values;
  }
  /// Passes over an array of so many numbers.
  template <class Value>
  void skip(std::size_t count) {
    align(sizeof(Value));
    cursor_.skip(count * sizeof(Value));
  }
  /// A list of bytes.
  std::span<const std::byte> read_bytes() { return cursor_.take(read<std::uint32_t>()); }
  /// CDR ends its texts in a zero, which it counts.
  std::string_view read_string() {
    std::string_view text = ByteCursor::text_of(read_bytes());
    if (!is_ros1() && text.ends_with('\0')) text.remove_suffix(1);
    return text;
  }
  /// How many structures follow. XCDR2 tells before how many bytes they take.
  std::uint32_t read_struct_count() {
    if (most_alignment_ == 4) (void)read<std::uint32_t>();
    return read<std::uint32_t>();
  }
  /// Seconds are unsigned in ROS 1 and signed in ROS 2.
  Stamp read_time() {
    const auto raw_s = read<std::uint32_t>();
    const std::int64_t s = is_ros1() ? std::int64_t{raw_s} : std::bit_cast<std::int32_t>(raw_s);
    const std::int64_t ns = read<std::uint32_t>();
    return {s * 1'000'000'000 + ns};
  }

 private:
  static constexpr std::size_t kMostPadding = 8;

  void read_cdr_header() {
    const auto header = cursor_.read_array<std::uint8_t, 4>();
    const unsigned kind = header[0] * 256U + header[1];
    is_big_endian_ = kind % 2 == 0;
    most_alignment_ = 8;
    if (kind == 6 || kind == 7) most_alignment_ = 4;  // XCDR2
    if (kind > 1 && most_alignment_ == 8) break_off();
  }
  void align(std::size_t size) {
    const std::size_t to = std::min(size, most_alignment_);
    cursor_.skip((to - (body_bytes_ - cursor_.left()) % to) % to);
  }
  void break_off() { cursor_.skip(cursor_.left() + 1); }

  ByteCursor cursor_;
  std::size_t body_bytes_ = 0;
  std::size_t most_alignment_ = 1;
  bool is_big_endian_ = false;
};

}  // namespace swiftlet
