// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/mcap/mcap_writer.hpp"

#include <zstd.h>

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>

#include "swiftlet/bag/mcap/mcap_index.hpp"
#include "swiftlet/bag/mcap/mcap_records.hpp"
#include "swiftlet/bag/mcap/record_writer.hpp"
#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/narrow.hpp"

namespace swiftlet {
namespace {

using Bytes = std::vector<std::uint8_t>;
using mcap::Op;
using mcap::RecordWriter;

constexpr std::string_view kLibrary = "swiftlet";
constexpr Nanoseconds kLongestChunk = std::chrono::seconds(1);

std::uint64_t ns_of(Stamp time) { return static_cast<std::uint64_t>(time.ns); }

}  // namespace

class McapWriter::State {
 public:
  State(ByteSinkPtr sink, Options options)
      : options_(std::move(options)),
        sink_(std::move(sink)),
        packer_(ZSTD_createCCtx(), ZSTD_freeCCtx) {
    index_.compression = options_.is_packed ? "zstd" : "";
  }

  Status begin() {
    Bytes start(mcap::kMagic.begin(), mcap::kMagic.end());
    RecordWriter(start).record(Op::kHeader, [&](RecordWriter& body) {
      body.text(options_.profile);
      body.text(kLibrary);
    });
    return put(start);
  }

  std::uint16_t add_topic(const mcap::WrittenSchema& schema, mcap::WrittenChannel channel) {
    SWIFTLET_REQUIRE(index_.channels.size() + 1 < std::numeric_limits<std::uint16_t>::max(),
                     "fewer topics than an MCAP file can number");
    RecordWriter out(chunk_);
    const auto known = std::ranges::find(index_.schemas, schema.name, &mcap::WrittenSchema::name);
    channel.schema = to<std::uint16_t>(known - index_.schemas.begin() + 1);
    if (known == index_.schemas.end()) {
      index_.schemas.push_back(schema);
      write_schema(out, channel.schema, schema);
    }
    index_.channels.push_back(std::move(channel));
    const auto id = to<std::uint16_t>(index_.channels.size());
    write_channel(out, id, index_.channels.back());
    return id;
  }

  Status write(std::uint16_t id, Stamp time, std::span<const std::uint8_t> data) {
    SWIFTLET_REQUIRE(id >= 1 && id <= index_.channels.size() && time.ns >= 0, "a topic and a time");
    if (failed_) return tl::make_unexpected(*failed_);
    const std::uint64_t ns = ns_of(time);
    const bool is_long = has_messages_ && ns > first_ns_ &&
                         ns - first_ns_ > static_cast<std::uint64_t>(kLongestChunk.count());
    if (is_long) {
      if (auto flushed = flush(); !flushed) return flushed;
    }
    mcap::WrittenChannel& channel = index_.channels[id - 1U];
    channel.index.emplace_back(ns, chunk_.size());
    RecordWriter(chunk_).record(Op::kMessage, [&](RecordWriter& body) {
      body.u16(id);
      body.u32(static_cast<std::uint32_t>(channel.messages));
      body.u64(ns);
      body.u64(ns);
      body.bytes(data);
    });
    ++channel.messages;
    first_ns_ = has_messages_ ? std::min(first_ns_, ns) : ns;
    last_ns_ = has_messages_ ? std::max(last_ns_, ns) : ns;
    has_messages_ = true;
    return chunk_.size() < options_.chunk_bytes ? Status(Done{}) : flush();
  }

  Status write_metadata(std::string_view name, const Metadata& words) {
    if (auto flushed = flush(); !flushed) return flushed;
    Bytes record;
    RecordWriter(record).record(Op::kMetadata, [&](RecordWriter& body) {
      body.text(name);
      body.with_length<std::uint32_t>([&] {
        for (const auto& [key, value] : words) {
          body.text(key);
          body.text(value);
        }
      });
    });
    index_.metadata.push_back({std::string(name), offset_, record.size()});
    return put(record);
  }

  Status flush() {
    if (failed_) return tl::make_unexpected(*failed_);
    if (chunk_.empty()) return Done{};
    auto packed = pack();
    if (!packed) return forward_error(std::move(packed));
    mcap::WrittenChunk written{first_ns_, last_ns_, offset_,        0,
                               {},        0,        packed->size(), chunk_.size()};
    Bytes record;
    RecordWriter(record).record(Op::kChunk, [&](RecordWriter& body) {
      body.u64(first_ns_);
      body.u64(last_ns_);
      body.u64(chunk_.size());
      body.u32(mcap::crc32(std::as_bytes(std::span(chunk_))));
      body.text(index_.compression);
      body.u64(packed->size());
      body.bytes(*packed);
    });
    written.bytes = record.size();
    index_.write_message_indexes(record, offset_, written);
    index_.chunks.push_back(std::move(written));
    chunk_.clear();
    has_messages_ = false;
    first_ns_ = last_ns_ = 0;
    return put(record);
  }

  Status close() {
    if (auto flushed = flush(); !flushed) return flushed;
    Bytes end;
    RecordWriter(end).record(Op::kDataEnd, [&](RecordWriter& body) { body.u32(crc_); });
    if (auto put_end = put(end); !put_end) return put_end;
    return put(index_.summary(offset_));
  }

  [[nodiscard]] std::uint64_t messages() const { return index_.messages(); }

 private:
  Expected<std::span<const std::uint8_t>> pack() {
    if (!options_.is_packed) return std::span<const std::uint8_t>(chunk_);
    constexpr int kFast = 1;
    packed_.resize(ZSTD_compressBound(chunk_.size()));
    const std::size_t bytes = ZSTD_compressCCtx(packer_.get(), packed_.data(), packed_.size(),
                                                chunk_.data(), chunk_.size(), kFast);
    if (ZSTD_isError(bytes) != 0U)
      return fail(ErrorCode::kOutOfMemory, "mcap", "a chunk cannot be packed");
    return std::span<const std::uint8_t>(packed_).first(bytes);
  }

  Status put(const Bytes& bytes) {
    if (failed_) return tl::make_unexpected(*failed_);
    auto written = sink_->write(bytes);
    if (!written) failed_ = written.error();
    offset_ += bytes.size();
    crc_ = mcap::crc32(std::as_bytes(std::span(bytes)), crc_);
    return written;
  }

  Options options_;
  ByteSinkPtr sink_;
  std::unique_ptr<ZSTD_CCtx, decltype(&ZSTD_freeCCtx)> packer_;
  std::uint64_t offset_ = 0;  // bytes written
  std::uint32_t crc_ = 0;     // of these
  mcap::McapIndex index_;
  Bytes chunk_, packed_;
  bool has_messages_ = false;  // in chunk_
  std::uint64_t first_ns_ = 0, last_ns_ = 0;
  std::optional<Error> failed_;
};

McapWriter::McapWriter(std::unique_ptr<State> state) : state_(std::move(state)) {}
McapWriter::McapWriter(McapWriter&&) noexcept = default;
McapWriter::~McapWriter() = default;

Expected<McapWriter> McapWriter::create(ByteSinkPtr sink, Options options) {
  auto state = std::make_unique<State>(std::move(sink), std::move(options));
  if (auto begun = state->begin(); !begun) return forward_error(std::move(begun));
  return McapWriter(std::move(state));
}

std::uint16_t McapWriter::add_topic(std::string_view topic, std::string_view type,
                                    std::string_view schema_encoding, std::string_view definition,
                                    std::string_view message_encoding) {
  return state_->add_topic(
      {std::string(type), std::string(schema_encoding), std::string(definition)},
      {.topic = std::string(topic), .encoding = std::string(message_encoding)});
}

Status McapWriter::write(std::uint16_t topic, Stamp time, std::span<const std::uint8_t> data) {
  return state_->write(topic, time, data);
}
Status McapWriter::write_metadata(std::string_view name, const Metadata& words) {
  return state_->write_metadata(name, words);
}
Status McapWriter::flush() { return state_->flush(); }
Status McapWriter::close() { return state_->close(); }
std::uint64_t McapWriter::messages() const { return state_->messages(); }

}  // namespace swiftlet
