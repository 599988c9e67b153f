// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

// The records of an MCAP file, as its reader and its writer know them. A record is `u8 kind, u64
// length` and its body, little-endian; texts and lists stand behind four bytes of length in bytes.
// Source: mcap.dev/spec.

namespace swiftlet::mcap {

inline constexpr std::string_view kMagic = "\x89MCAP0\r\n";  // at both ends of a file
inline constexpr std::size_t kHeadBytes = 9;

/// Kinds of records (the values are on disk).
enum class Op : std::uint8_t {
  kHeader = 0x01,
  kFooter = 0x02,
  kSchema = 0x03,
  kChannel = 0x04,
  kMessage = 0x05,
  kChunk = 0x06,
  kMessageIndex = 0x07,
  kChunkIndex = 0x08,
  kAttachment = 0x09,
  kAttachmentIndex = 0x0A,
  kStatistics = 0x0B,
  kMetadata = 0x0C,
  kMetadataIndex = 0x0D,
  kSummaryOffset = 0x0E,
  kDataEnd = 0x0F,
};

struct RecordHead {
  Op op;
  std::uint64_t body_bytes;
};
[[nodiscard]] RecordHead parse_head(std::span<const std::byte, kHeadBytes> bytes);

using Body = std::span<const std::byte>;

// Bodies. Views point into the bytes; nullopt if they are no such record. A reader passes over what
// a later version of the format has added behind the fields.

struct Header {
  std::string_view profile;  ///< "ros1", "ros2" or whatever a writer agreed on with its readers
  std::string_view library;
};
[[nodiscard]] std::optional<Header> parse_header(Body body);

struct Schema {
  std::uint16_t id = 0;
  std::string_view name;      ///< of the type, as in "sensor_msgs/msg/Image"
  std::string_view encoding;  ///< of the definition, as in "ros2msg"
  Body data;                  ///< the definition
};
[[nodiscard]] std::optional<Schema> parse_schema(Body body);

struct Channel {
  std::uint16_t id = 0;
  std::uint16_t schema_id = 0;  ///< 0: none
  std::string_view topic;
  std::string_view message_encoding;  ///< "cdr", "ros1", "json" ...
};
[[nodiscard]] std::optional<Channel> parse_channel(Body body);

struct Message {
  std::uint16_t channel_id = 0;
  std::uint32_t sequence = 0;
  std::uint64_t log_time_ns = 0;
  std::uint64_t publish_time_ns = 0;
  Body data;
};
[[nodiscard]] std::optional<Message> parse_message(Body body);

struct Chunk {
  std::uint64_t start_ns = 0, end_ns = 0;
  std::uint64_t unpacked_bytes = 0;
  std::uint32_t unpacked_crc = 0;  ///< 0: the writer has not computed it
  std::string_view compression;    ///< "", "lz4", "zstd"
  Body records;                    ///< packed
};
[[nodiscard]] std::optional<Chunk> parse_chunk(Body body);

/// The CRC-32 of all bytes before the record; 0: the writer has not computed it.
[[nodiscard]] std::optional<std::uint32_t> parse_data_end(Body body);

/// CRC-32 as in zlib, carried on from `before`.
[[nodiscard]] std::uint32_t crc32(Body bytes, std::uint32_t before = 0);

}  // namespace swiftlet::mcap
