// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/bag_record.hpp"

#include "swiftlet/bag/byte_cursor.hpp"

namespace swiftlet {
namespace {

/// A number that must fill its field; false if it does not.
template <class Value>
bool assign(std::string_view text, std::optional<Value>& out) {
  ByteCursor cursor(std::as_bytes(std::span(text)));
  out = cursor.read<Value>();
  return cursor.is_good() && cursor.left() == 0;
}

bool assign(std::string_view text, std::optional<BagOp>& out) {
  std::optional<std::uint8_t> value;
  if (!assign(text, value)) return false;
  out = static_cast<BagOp>(*value);
  return true;
}

/// Seconds and nanoseconds, both unsigned.
bool assign(std::string_view text, std::optional<Stamp>& out) {
  ByteCursor cursor(std::as_bytes(std::span(text)));
  const std::int64_t s = cursor.read<std::uint32_t>();
  const std::int64_t ns = cursor.read<std::uint32_t>();
  out = Stamp{s * 1'000'000'000 + ns};
  return cursor.is_good() && cursor.left() == 0;
}

bool assign(std::string_view text, std::string_view& out) {
  out = text;
  return true;
}

bool keep(std::string_view name, std::string_view value, BagFields& fields) {
  if (name == "op") return assign(value, fields.op);
  if (name == "conn") return assign(value, fields.conn);
  if (name == "size") return assign(value, fields.size);
  if (name == "count") return assign(value, fields.count);
  if (name == "index_pos") return assign(value, fields.index_pos);
  if (name == "chunk_pos") return assign(value, fields.chunk_pos);
  if (name == "time") return assign(value, fields.time);
  if (name == "start_time") return assign(value, fields.start_time);
  if (name == "end_time") return assign(value, fields.end_time);
  if (name == "compression") return assign(value, fields.compression);
  if (name == "topic") return assign(value, fields.topic);
  if (name == "type") return assign(value, fields.type);
  if (name == "md5sum") return assign(value, fields.md5sum);
  return true;  // "a reader must ignore fields it does not know" (the format's own rule)
}

}  // namespace

std::optional<BagFields> parse_bag_fields(std::span<const std::byte> header) {
  BagFields fields;
  ByteCursor cursor(header);
  while (cursor.left() > 0) {
    const std::string_view field = cursor.read_string();
    const std::size_t equals = field.find('=');
    if (!cursor.is_good() || equals == std::string_view::npos) return std::nullopt;
    if (!keep(field.substr(0, equals), field.substr(equals + 1), fields)) return std::nullopt;
  }
  return fields;
}

}  // namespace swiftlet
