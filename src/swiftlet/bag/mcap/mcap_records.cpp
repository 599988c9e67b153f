// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/mcap/mcap_records.hpp"

#include <zlib.h>

#include "swiftlet/bag/byte_cursor.hpp"

namespace swiftlet::mcap {
namespace {

template <class Record>
std::optional<Record> if_good(const ByteCursor& cursor, const Record& record) {
  return cursor.is_good() ? std::optional(record) : std::nullopt;
}

}  // namespace

RecordHead parse_head(std::span<const std::byte, kHeadBytes> bytes) {
  ByteCursor cursor(bytes);
  const auto op = static_cast<Op>(cursor.read<std::uint8_t>());
  return {op, cursor.read<std::uint64_t>()};
}

std::optional<Header> parse_header(Body body) {
  ByteCursor cursor(body);
  Header header;
  header.profile = cursor.read_string();
  header.library = cursor.read_string();
  return if_good(cursor, header);
}

std::optional<Schema> parse_schema(Body body) {
  ByteCursor cursor(body);
  Schema schema;
  schema.id = cursor.read<std::uint16_t>();
  schema.name = cursor.read_string();
  schema.encoding = cursor.read_string();
  schema.data = cursor.take(cursor.read<std::uint32_t>());
  return if_good(cursor, schema);
}

std::optional<Channel> parse_channel(Body body) {
  ByteCursor cursor(body);
  Channel channel;
  channel.id = cursor.read<std::uint16_t>();
  channel.schema_id = cursor.read<std::uint16_t>();
  channel.topic = cursor.read_string();
  channel.message_encoding = cursor.read_string();
  cursor.skip(cursor.read<std::uint32_t>());  // metadata: names and values
  return if_good(cursor, channel);
}

std::optional<Message> parse_message(Body body) {
  ByteCursor cursor(body);
  Message message;
  message.channel_id = cursor.read<std::uint16_t>();
  message.sequence = cursor.read<std::uint32_t>();
  message.log_time_ns = cursor.read<std::uint64_t>();
  message.publish_time_ns = cursor.read<std::uint64_t>();
  message.data = cursor.take(cursor.left());
  return if_good(cursor, message);
}

std::optional<Chunk> parse_chunk(Body body) {
  ByteCursor cursor(body);
  Chunk chunk;
  chunk.start_ns = cursor.read<std::uint64_t>();
  chunk.end_ns = cursor.read<std::uint64_t>();
  chunk.unpacked_bytes = cursor.read<std::uint64_t>();
  chunk.unpacked_crc = cursor.read<std::uint32_t>();
  chunk.compression = cursor.read_string();
  const auto packed_bytes = cursor.read<std::uint64_t>();
  chunk.records = cursor.take(packed_bytes);
  return if_good(cursor, chunk);
}

std::optional<std::uint32_t> parse_data_end(Body body) {
  ByteCursor cursor(body);
  const auto crc = cursor.read<std::uint32_t>();
  return if_good(cursor, crc);
}

std::uint32_t crc32(Body bytes, std::uint32_t before) {
  return static_cast<std::uint32_t>(
      ::crc32_z(before, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace swiftlet::mcap
