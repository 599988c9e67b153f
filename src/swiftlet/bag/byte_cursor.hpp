// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string_view>
#include <type_traits>

namespace swiftlet {

/// Reads little-endian values one after the other out of bytes of which nothing is trusted. Once a
/// read has gone beyond the end, the cursor stays broken and every value is 0 or empty, so that a
/// parser needs one check at its end.
class ByteCursor {
 public:
  explicit ByteCursor(std::span<const std::byte> bytes) : rest_(bytes) {}

  [[nodiscard]] bool is_good() const { return is_good_; }
  [[nodiscard]] std::size_t left() const { return rest_.size(); }

  /// The next `count` bytes.
  std::span<const std::byte> take(std::size_t count) {
    if (count > rest_.size()) {
      is_good_ = false;
      rest_ = {};
      return {};
    }
    const auto taken = rest_.first(count);
    rest_ = rest_.subspan(count);
    return taken;
  }
  void skip(std::size_t count) { (void)take(count); }

  template <class Value>
  Value read() {
    static_assert(std::is_arithmetic_v<Value>);
    Value value{};
    const auto bytes = take(sizeof(Value));
    // The hosts that Swiftlet runs on (x86-64, aarch64) are little-endian, as the format is.
    if (!bytes.empty()) std::memcpy(&value, bytes.data(), sizeof(Value));
    return value;
  }
  template <class Value, std::size_t N>
  std::array<Value, N> read_array() {
    std::array<Value, N> values{};
    for (Value& value : values) value = read<Value>();
    return values;
  }
  /// Four bytes of length, then as many characters.
  std::string_view read_string() {
    const auto bytes = take(read<std::uint32_t>());
    return text_of(bytes);
  }

  [[nodiscard]] static std::string_view text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
  }

 private:
  std::span<const std::byte> rest_;
  bool is_good_ = true;
};

}  // namespace swiftlet
