// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swiftlet/bag/mcap/record_writer.hpp"

// What the writer of an MCAP file remembers of what it has written, for the index at its end.

namespace swiftlet::mcap {

/// A type and its definition.
struct WrittenSchema {
  std::string name, encoding, definition;
};

/// A topic.
struct WrittenChannel {
  std::uint16_t schema = 0;
  std::string topic, encoding;
  std::uint64_t messages = 0;
  std::vector<std::pair<std::uint64_t, std::uint64_t>> index{};  // of the chunk: time, place
};

/// What the index at the end tells of a chunk.
struct WrittenChunk {
  std::uint64_t first_ns, last_ns;
  std::uint64_t offset, bytes;
  std::map<std::uint16_t, std::uint64_t> index_offsets;
  std::uint64_t index_bytes;
  std::uint64_t packed_bytes, unpacked_bytes;
};

struct WrittenMetadata {
  std::string name;
  std::uint64_t offset, bytes;
};

void write_schema(RecordWriter& out, std::uint16_t id, const WrittenSchema& schema);
void write_channel(RecordWriter& out, std::uint16_t id, const WrittenChannel& channel);

/// Schemas and channels are numbered by their places here, from 1.
struct McapIndex {
  std::vector<WrittenSchema> schemas;
  std::vector<WrittenChannel> channels;
  std::vector<WrittenChunk> chunks;
  std::vector<WrittenMetadata> metadata;
  std::string_view compression;  ///< of the chunks

  [[nodiscard]] std::uint64_t messages() const;

  /// Writes where the messages of the chunk are that has been filled, behind it, and forgets them.
  /// `offset`: of the file, where `record` begins.
  void write_message_indexes(std::vector<std::uint8_t>& record, std::uint64_t offset,
                             WrittenChunk& chunk);
  /// From the end of the data, which is at `offset`, to the end of the file.
  [[nodiscard]] std::vector<std::uint8_t> summary(std::uint64_t offset) const;

 private:
  void write_statistics(RecordWriter& body) const;
};

}  // namespace swiftlet::mcap
