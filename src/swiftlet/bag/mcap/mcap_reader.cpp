// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/mcap/mcap_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <string_view>

#include "swiftlet/bag/byte_cursor.hpp"
#include "swiftlet/bag/chunk_codec.hpp"

namespace swiftlet {
namespace {

using mcap::Op;

constexpr std::uint64_t kMostHeaderBytes = 64U << 10U;
constexpr std::uint64_t kMostSchemaBytes = 4U << 20U;  // holds the definition of its type
constexpr std::uint64_t kMostChannelBytes = 1U << 20U;
constexpr std::uint64_t kChunkHeadBytes = 4096;  // 40 and the name of the compression
constexpr std::size_t kSumStepBytes = 1U << 20U;

/// The most that the body of a record may hold that is read as a whole.
std::uint64_t most_bytes_of(Op op) {
  switch (op) {
    case Op::kMessage:
      return kMaxChunkBytes;
    case Op::kSchema:
      return kMostSchemaBytes;
    case Op::kChannel:
      return kMostChannelBytes;
    default:
      return kMostHeaderBytes;
  }
}

}  // namespace

bool has_mcap_magic(std::span<const std::byte> start) {
  constexpr std::size_t kVersionAt = 5;
  const std::string_view text = ByteCursor::text_of(start);
  return text.substr(0, kVersionAt) == mcap::kMagic.substr(0, kVersionAt);
}

void McapReader::end() {
  position_ = bytes_->size();
  chunk_ = {};
}

tl::unexpected<Error> McapReader::corrupt(std::uint64_t offset, std::string what) {
  end();
  return fail(ErrorCode::kCorruptInput, fmt::format("{}: byte {}", bytes_->name(), offset),
              std::move(what), "the recording is damaged there; copy it again");
}

tl::unexpected<Error> McapReader::cut_off(std::uint64_t offset, std::string what) {
  end();
  return fail(ErrorCode::kCorruptInput, fmt::format("{}: byte {}", bytes_->name(), offset),
              fmt::format("{} begins here, but the file ends at byte {}", what, bytes_->size()),
              "its recorder was stopped or the copy was cut off; what comes before is sound");
}

Expected<McapReader> McapReader::open(ByteSourcePtr bytes) {
  McapReader reader(std::move(bytes));
  const std::string& name = reader.name();
  std::array<std::byte, mcap::kMagic.size()> magic{};
  const std::size_t present = std::min<std::uint64_t>(magic.size(), reader.bytes_->size());
  const auto start = std::span(magic).first(present);
  if (auto read = reader.bytes_->read(0, start); !read) return forward_error(std::move(read));
  if (ByteCursor::text_of(start) != mcap::kMagic) {
    if (present == magic.size() && has_mcap_magic(start))
      return fail(ErrorCode::kUnsupported, name, "it is an MCAP file of another version than 0",
                  "convert it with the tool `mcap`");
    return fail(ErrorCode::kCorruptInput, name, "it is no MCAP file");
  }
  reader.position_ = magic.size();
  reader.data_crc_ = mcap::crc32(magic);
  return reader;
}

RecordingInfo McapReader::info() const {
  RecordingInfo info{.format = "MCAP", .chunks = chunks_, .compression = compression_};
  if (!profile_.empty()) info.format += fmt::format(", profile {}", profile_);
  info.is_closed = is_closed_;
  return info;
}

Expected<std::optional<McapReader::FileRecord>> McapReader::next_record() {
  const std::uint64_t offset = position_;
  const std::uint64_t left = bytes_->size() - offset;
  if (left == 0) return std::nullopt;
  std::array<std::byte, mcap::kHeadBytes> raw{};
  if (left < raw.size()) return cut_off(offset, "a record");
  if (auto read = bytes_->read(offset, raw); !read) {
    end();
    return forward_error(std::move(read));
  }
  const FileRecord record{mcap::parse_head(raw), offset};
  if (record.head.op == Op{}) return cut_off(offset, "nothing but zeros");  // power was lost
  if (record.head.body_bytes > left - raw.size())
    return cut_off(offset, fmt::format("a record of {} bytes", record.head.body_bytes));
  if (data_crc_ && record.head.op != Op::kDataEnd) data_crc_ = mcap::crc32(raw, *data_crc_);
  position_ = offset + raw.size() + record.head.body_bytes;
  return record;
}

/// Reads the body into body_. It lies within the file, which bounds what a lie about it costs.
Expected<mcap::Body> McapReader::body_of(const FileRecord& record, std::uint64_t most_bytes) {
  if (record.head.body_bytes > most_bytes)
    return corrupt(record.offset, fmt::format("a record of {} bytes of kind {} cannot be",
                                              record.head.body_bytes, int(record.head.op)));
  if (body_.size() < record.head.body_bytes) body_.resize(record.head.body_bytes);
  const auto body = std::span(body_).first(record.head.body_bytes);
  if (auto read = bytes_->read(record.offset + mcap::kHeadBytes, body); !read) {
    end();
    return forward_error(std::move(read));
  }
  if (data_crc_ && record.head.op != Op::kDataEnd) data_crc_ = mcap::crc32(body, *data_crc_);
  return body;
}

/// A record that is not needed counts for the checksum all the same.
Status McapReader::pass_over(const FileRecord& record) {
  if (!data_crc_) return Done{};
  body_.resize(std::max(body_.size(), kSumStepBytes));
  for (std::uint64_t done = 0; done < record.head.body_bytes;) {
    const auto step = std::span(body_).first(
        std::min<std::uint64_t>(kSumStepBytes, record.head.body_bytes - done));
    auto read = bytes_->read(record.offset + mcap::kHeadBytes + done, step);
    if (!read) {
      end();
      return read;
    }
    data_crc_ = mcap::crc32(step, *data_crc_);
    done += step.size();
  }
  return Done{};
}

Status McapReader::unpack(const mcap::Chunk& chunk, std::uint64_t offset) {
  packed_bytes_ += chunk.records.size();
  unpacked_bytes_ += chunk.unpacked_bytes;
  if (chunk.unpacked_bytes > kMaxChunkBytes ||
      !is_growth_plausible(packed_bytes_, unpacked_bytes_)) {
    return corrupt(offset, fmt::format("a chunk of {} bytes that unpacks to {} cannot be",
                                       chunk.records.size(), chunk.unpacked_bytes));
  }
  if (chunk.compression.empty()) {
    chunk_ = chunk.records;
    if (chunk_.size() == chunk.unpacked_bytes) return Done{};
    return corrupt(offset, fmt::format("a chunk holds {} bytes where {} were promised",
                                       chunk_.size(), chunk.unpacked_bytes));
  }
  const auto size = static_cast<std::uint32_t>(chunk.unpacked_bytes);
  const bool is_known = chunk.compression == "lz4" || chunk.compression == "zstd";
  auto fault = is_known ? unpack_chunk(chunk.compression, chunk.records, size, unpacked_)
                        : fmt::format("its compression '{}' is unknown", chunk.compression);
  if (fault) return corrupt(offset, "the chunk that begins here cannot be unpacked: " + *fault);
  chunk_ = unpacked_;
  return Done{};
}

Status McapReader::begin_chunk(const FileRecord& record) {
  data_crc_ = std::nullopt;  // the chunks have their own
  auto body = body_of(record, kMaxChunkBytes + kChunkHeadBytes);
  if (!body) return forward_error(std::move(body));
  const auto chunk = mcap::parse_chunk(*body);
  if (!chunk) return corrupt(record.offset, "the chunk that begins here is malformed");
  if (auto unpacked = unpack(*chunk, record.offset); !unpacked) return unpacked;
  if (chunk->unpacked_crc != 0 && mcap::crc32(chunk_) != chunk->unpacked_crc)
    return corrupt(record.offset, "the chunk that begins here fails its checksum");
  compression_.emplace(chunk->compression.empty() ? "none" : chunk->compression);
  chunk_offset_ = record.offset;
  ++chunks_;
  return Done{};
}

Status McapReader::check_data(const FileRecord& record) {
  is_closed_ = true;
  auto body = body_of(record, kMostHeaderBytes);
  if (!body) return forward_error(std::move(body));
  const auto crc = mcap::parse_data_end(*body);
  if (!crc) return corrupt(record.offset, "the end of the data is malformed");
  if (*crc != 0 && data_crc_ && *crc != *data_crc_)
    return corrupt(record.offset, "the data before this byte fail their checksum");
  end();  // what follows is the index
  return Done{};
}

McapReader::MessageOrNone McapReader::message_of(mcap::Body body, std::uint64_t offset) {
  const auto message = mcap::parse_message(body);
  if (!message) return corrupt(offset, "a message here is malformed");
  const auto channel = topics_.channels().find(message->channel_id);
  if (channel == topics_.channels().end())
    return corrupt(offset, "a message here tells no known topic");
  constexpr std::uint64_t kLatest = std::numeric_limits<std::int64_t>::max();
  if (message->log_time_ns > kLatest) return corrupt(offset, "a message here tells no time");
  return BagMessage{&channel->second, Stamp{static_cast<std::int64_t>(message->log_time_ns)},
                    message->data, offset};
}

/// A record that may stand in a chunk or outside.
McapReader::MessageOrNone McapReader::take(Op op, mcap::Body body, std::uint64_t offset) {
  if (op == Op::kMessage) return message_of(body, offset);
  std::optional<std::string> fault;
  if (op == Op::kSchema) fault = topics_.add_schema(body);
  if (op == Op::kChannel) fault = topics_.add_channel(body);
  if (fault) return corrupt(offset, std::move(*fault));
  return std::nullopt;
}

McapReader::MessageOrNone McapReader::next_in_chunk() {
  while (!chunk_.empty()) {
    if (chunk_.size() < mcap::kHeadBytes)
      return corrupt(chunk_offset_, "the chunk that begins here ends within a record");
    const auto head = mcap::parse_head(chunk_.first<mcap::kHeadBytes>());
    chunk_ = chunk_.subspan(mcap::kHeadBytes);
    if (head.body_bytes > chunk_.size())
      return corrupt(chunk_offset_, "the chunk that begins here ends within a record");
    const auto body = chunk_.first(head.body_bytes);
    chunk_ = chunk_.subspan(body.size());
    auto message = take(head.op, body, chunk_offset_);
    if (!message || *message) return message;
  }
  return std::nullopt;
}

/// A record outside of chunks; the message, if it is one.
McapReader::MessageOrNone McapReader::look_at(const FileRecord& record) {
  const Op op = record.head.op;
  const bool is_read =
      op == Op::kHeader || op == Op::kSchema || op == Op::kChannel || op == Op::kMessage;
  if (is_read) {
    auto body = body_of(record, most_bytes_of(op));
    if (!body) return forward_error(std::move(body));
    if (op != Op::kHeader) return take(op, *body, record.offset);
    if (const auto header = mcap::parse_header(*body)) profile_ = header->profile;
    return std::nullopt;
  }
  auto done = op == Op::kChunk     ? begin_chunk(record)
              : op == Op::kDataEnd ? check_data(record)
                                   : pass_over(record);
  if (!done) return forward_error(std::move(done));
  return std::nullopt;
}

/// Reads on to the next message outside of chunks, the next chunk, or the end.
McapReader::MessageOrNone McapReader::next_in_file() {
  while (chunk_.empty()) {
    auto record = next_record();
    if (!record) return forward_error(std::move(record));
    if (!*record || (*record)->head.op == Op::kFooter) {
      end();
      return std::nullopt;
    }
    auto message = look_at(**record);
    if (!message || *message) return message;
  }
  return std::nullopt;
}

Expected<std::optional<BagMessage>> McapReader::read_next() {
  while (true) {
    auto message = next_in_chunk();
    if (!message || *message) return message;
    message = next_in_file();
    if (!message || *message || chunk_.empty()) return message;
  }
}

}  // namespace swiftlet
