// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/text_encoding.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace swiftlet {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
constexpr std::string_view kUtf16LittleMark = "\xFF\xFE";
constexpr std::string_view kUtf16BigMark = "\xFE\xFF";
constexpr std::uint32_t kReplacement = 0xFFFD;

/// The 16-bit units of a text, one after the other.
class Units {
 public:
  Units(std::string_view bytes, bool is_big_endian) : rest_(bytes), is_big_(is_big_endian) {}

  [[nodiscard]] bool has_more() const { return rest_.size() >= 2; }
  [[nodiscard]] std::uint32_t peek() const {
    const std::uint32_t first = static_cast<unsigned char>(rest_[0]);
    const std::uint32_t second = static_cast<unsigned char>(rest_[1]);
    return is_big_ ? first << 8 | second : second << 8 | first;
  }
  std::uint32_t take() {
    const std::uint32_t unit = peek();
    rest_.remove_prefix(2);
    return unit;
  }

 private:
  std::string_view rest_;
  bool is_big_;
};

bool is_high_half(std::uint32_t unit) { return unit >= 0xD800 && unit < 0xDC00; }
bool is_low_half(std::uint32_t unit) { return unit >= 0xDC00 && unit < 0xE000; }

std::uint32_t next_code(Units& units) {
  const std::uint32_t unit = units.take();
  if (is_high_half(unit) && units.has_more() && is_low_half(units.peek()))
    return 0x10000 + ((unit - 0xD800) << 10) + (units.take() - 0xDC00);
  return is_high_half(unit) || is_low_half(unit) ? kReplacement : unit;
}

void append_utf8(std::string& text, std::uint32_t code) {
  const auto put = [&](std::uint32_t byte) { text.push_back(static_cast<char>(byte)); };
  const auto put_rest = [&](std::uint32_t shift) { put(0x80U | (code >> shift & 0x3FU)); };
  if (code < 0x80) return put(code);
  if (code < 0x800) {
    put(0xC0U | code >> 6);
  } else if (code < 0x10000) {
    put(0xE0U | code >> 12);
    put_rest(6);
  } else {
    put(0xF0U | code >> 18);
    put_rest(12);
    put_rest(6);
  }
  put_rest(0);
}

std::string from_utf16(std::string_view bytes, bool is_big_endian) {
  std::string text;
  text.reserve(bytes.size());
  for (Units units(bytes, is_big_endian); units.has_more();) append_utf8(text, next_code(units));
  return text;
}

}  // namespace

std::string without_byte_order_mark(std::string text) {
  const std::string_view view = text;
  if (view.starts_with(kUtf8Mark)) return text.substr(kUtf8Mark.size());
  if (view.starts_with(kUtf16LittleMark)) return from_utf16(view.substr(2), false);
  if (view.starts_with(kUtf16BigMark)) return from_utf16(view.substr(2), true);
  return text;
}

}  // namespace swiftlet
