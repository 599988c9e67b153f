// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/mcap/mcap_index.hpp"

#include <algorithm>
#include <limits>

#include "swiftlet/base/narrow.hpp"

namespace swiftlet::mcap {
namespace {

void write_chunk_index(RecordWriter& out, const WrittenChunk& chunk, std::string_view compression) {
  out.record(Op::kChunkIndex, [&](RecordWriter& body) {
    body.u64(chunk.first_ns);
    body.u64(chunk.last_ns);
    body.u64(chunk.offset);
    body.u64(chunk.bytes);
    body.with_length<std::uint32_t>([&] {
      for (const auto& [channel, offset] : chunk.index_offsets) {
        body.u16(channel);
        body.u64(offset);
      }
    });
    body.u64(chunk.index_bytes);
    body.text(compression);
    body.u64(chunk.packed_bytes);
    body.u64(chunk.unpacked_bytes);
  });
}

/// The checksum covers the footer up to itself, with its length: no RecordWriter, which fills that
/// in at the end.
void write_footer(std::vector<std::uint8_t>& summary, std::uint64_t summary_offset) {
  constexpr std::uint64_t kFooterBytes = 20;
  ByteWriter out(summary);
  out.u8(static_cast<std::uint8_t>(Op::kFooter));
  out.u64(kFooterBytes);
  out.u64(summary_offset);
  out.u64(0);  // groups of the summary are not listed
  out.u32(crc32(std::as_bytes(std::span(summary))));
  out.text(kMagic);
}

}  // namespace

void write_schema(RecordWriter& out, std::uint16_t id, const WrittenSchema& schema) {
  out.record(Op::kSchema, [&](RecordWriter& body) {
    body.u16(id);
    body.text(schema.name);
    body.text(schema.encoding);
    body.text(schema.definition);
  });
}

void write_channel(RecordWriter& out, std::uint16_t id, const WrittenChannel& channel) {
  out.record(Op::kChannel, [&](RecordWriter& body) {
    body.u16(id);
    body.u16(channel.schema);
    body.text(channel.topic);
    body.text(channel.encoding);
    body.u32(0);  // no metadata
  });
}

std::uint64_t McapIndex::messages() const {
  std::uint64_t sum = 0;
  for (const WrittenChannel& channel : channels) sum += channel.messages;
  return sum;
}

void McapIndex::write_message_indexes(std::vector<std::uint8_t>& record, std::uint64_t offset,
                                      WrittenChunk& chunk) {
  const std::size_t begin = record.size();
  RecordWriter out(record);
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (channels[i].index.empty()) continue;
    const auto id = to<std::uint16_t>(i + 1);
    chunk.index_offsets.emplace(id, offset + record.size());
    out.record(Op::kMessageIndex, [&](RecordWriter& body) {
      body.u16(id);
      body.with_length<std::uint32_t>([&] {
        for (const auto& [ns, place] : channels[i].index) {
          body.u64(ns);
          body.u64(place);
        }
      });
    });
    channels[i].index.clear();
  }
  chunk.index_bytes = record.size() - begin;
}

std::vector<std::uint8_t> McapIndex::summary(std::uint64_t offset) const {
  std::vector<std::uint8_t> summary;
  RecordWriter out(summary);
  for (std::size_t i = 0; i < schemas.size(); ++i)
    write_schema(out, to<std::uint16_t>(i + 1), schemas[i]);
  for (std::size_t i = 0; i < channels.size(); ++i)
    write_channel(out, to<std::uint16_t>(i + 1), channels[i]);
  out.record(Op::kStatistics, [&](RecordWriter& body) { write_statistics(body); });
  for (const WrittenChunk& chunk : chunks) write_chunk_index(out, chunk, compression);
  for (const WrittenMetadata& words : metadata) {
    out.record(Op::kMetadataIndex, [&](RecordWriter& body) {
      body.u64(words.offset);
      body.u64(words.bytes);
      body.text(words.name);
    });
  }
  write_footer(summary, offset);
  return summary;
}

void McapIndex::write_statistics(RecordWriter& body) const {
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max(), last = 0;
  for (const WrittenChunk& chunk : chunks) {
    if (chunk.index_offsets.empty()) continue;  // topics without a message
    first = std::min(first, chunk.first_ns);
    last = std::max(last, chunk.last_ns);
  }
  body.u64(messages());
  body.u16(to<std::uint16_t>(schemas.size()));
  body.u32(to<std::uint32_t>(channels.size()));
  body.u32(0);  // attachments
  body.u32(to<std::uint32_t>(metadata.size()));
  body.u32(to<std::uint32_t>(chunks.size()));
  body.u64(messages() == 0 ? 0 : first);
  body.u64(last);
  body.with_length<std::uint32_t>([&] {
    for (std::size_t i = 0; i < channels.size(); ++i) {
      body.u16(to<std::uint16_t>(i + 1));
      body.u64(channels[i].messages);
    }
  });
}

}  // namespace swiftlet::mcap
