// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/bag_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "swiftlet/bag/byte_cursor.hpp"
#include "swiftlet/bag/chunk_codec.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kMagic = "#ROSBAG V2.0\n";
constexpr std::array<std::string_view, 2> kAllMagic{"#ROSBAG V", "#ROSRECORD"};
constexpr std::uint32_t kMaxHeaderBytes = 64U << 10U;     // real ones have some 100 bytes
constexpr std::uint32_t kMaxConnectionBytes = 4U << 20U;  // holds the definition of its type
// bzip2 packs zeros 10 million times and unpacks them in a minute a gigabyte; depth, 3 to 20 times.
constexpr std::uint64_t kFreeBz2Bytes = 16U << 20U;
constexpr std::uint64_t kMaxBz2Growth = 64;
constexpr std::size_t kMaxConnections = 65536;

}  // namespace

bool has_bag_magic(std::span<const std::byte> start) {
  const std::string_view text = ByteCursor::text_of(start);
  return std::ranges::any_of(kAllMagic, [&](auto magic) { return text.starts_with(magic); });
}

bool is_bag_file(const std::filesystem::path& path) {
  const auto bytes = open_file_bytes(path);
  if (!bytes) return false;
  std::array<std::byte, kMagic.size()> start{};
  const auto head = std::span(start).first(std::min<std::uint64_t>(start.size(), (*bytes)->size()));
  return (*bytes)->read(0, head).has_value() && has_bag_magic(head);
}

tl::unexpected<Error> BagReader::corrupt(std::uint64_t offset, std::string what) {
  end();
  return fail(ErrorCode::kCorruptInput, fmt::format("{}: byte {}", bytes_->name(), offset),
              std::move(what), "the recording is damaged there; copy it again");
}

void BagReader::end() {
  position_ = bytes_->size();  // nothing more is read
  chunk_.clear();
  chunk_position_ = 0;
}

RecordingInfo BagReader::info() const {
  constexpr std::array<const char*, 3> kNames{"none", "lz4", "bz2"};
  RecordingInfo info{.format = "ROS bag 2.0", .chunks = chunks_};
  for (std::size_t i = 0; i < kNames.size(); ++i) {
    if (by_compression_[i] > 0) info.compression.insert(kNames[i]);
  }
  return info;
}

Expected<BagReader> BagReader::open(ByteSourcePtr bytes) {
  BagReader reader(std::move(bytes));
  const std::string& name = reader.bytes_->name();
  std::array<char, kMagic.size()> magic{};
  const std::size_t present = std::min<std::uint64_t>(magic.size(), reader.bytes_->size());
  auto read = reader.bytes_->read(0, std::as_writable_bytes(std::span(magic).first(present)));
  if (!read) return forward_error(std::move(read));
  const std::string_view start(magic.data(), present);
  if (start != kMagic) {
    if (has_bag_magic(std::as_bytes(std::span(start))))
      return fail(ErrorCode::kUnsupported, name, "it is a ROS bag of another version than 2.0",
                  "convert it with `rosbag fix`");
    return fail(ErrorCode::kCorruptInput, name, "it is no ROS bag",
                "RealSense recordings and `rosbag record` make such files");
  }
  reader.position_ = kMagic.size();
  return reader;
}

Expected<BagReader::FileRecord> BagReader::read_record() {
  const std::uint64_t offset = position_;
  const auto length_at = [&](std::uint64_t place) -> Expected<std::uint32_t> {
    std::array<std::byte, 4> raw{};
    if (auto read = bytes_->read(place, raw); !read) return forward_error(std::move(read));
    return ByteCursor(raw).read<std::uint32_t>();
  };
  const auto header_bytes = length_at(offset);
  if (!header_bytes) return tl::make_unexpected(header_bytes.error());
  if (*header_bytes > kMaxHeaderBytes)
    return corrupt(offset, fmt::format("a record header of {} bytes cannot be", *header_bytes));
  header_.resize(*header_bytes);
  if (auto read = bytes_->read(offset + 4, header_); !read) return forward_error(std::move(read));
  const auto data_bytes = length_at(offset + 4 + *header_bytes);
  if (!data_bytes) return tl::make_unexpected(data_bytes.error());

  const auto fields = parse_bag_fields(header_);
  if (!fields || !fields->op) return corrupt(offset, "it is not the header of a record");
  const std::uint64_t data_offset = offset + 8 + *header_bytes;
  if (*data_bytes > bytes_->size() - std::min(bytes_->size(), data_offset)) {
    return corrupt(offset, fmt::format("a record of {} bytes begins here, but the file ends at "
                                       "byte {}",
                                       *data_bytes, bytes_->size()));
  }
  position_ = data_offset + *data_bytes;
  return FileRecord{*fields, offset, data_offset, *data_bytes};
}

Status BagReader::check_budget(const FileRecord& record) {
  if (record.fields.compression != "bz2") return Done{};
  bz2_packed_ += record.data_bytes;
  bz2_unpacked_ += *record.fields.size;
  const std::uint64_t budget = kFreeBz2Bytes + kMaxBz2Growth * bz2_packed_;
  if (bz2_unpacked_ <= budget) return Done{};
  auto fault = corrupt(record.offset,
                       fmt::format("{} bytes of bzip2 so far would unpack to {}, more than images "
                                   "do and than this reader takes the time for",
                                   bz2_packed_, bz2_unpacked_));
  fault.value().remedy = "if it is meant, unpack it with `rosbag decompress` first";
  return fault;
}

Status BagReader::unpack(const FileRecord& record) {
  if (!record.fields.size) return corrupt(record.offset, "a chunk does not tell its size");
  if (record.data_bytes > kMaxChunkBytes)
    return corrupt(
        record.offset,
        fmt::format("a chunk of {} bytes is larger than any camera writes", record.data_bytes));
  if (auto affordable = check_budget(record); !affordable) return affordable;
  const std::string compression(record.fields.compression);  // header_ is used again
  packed_.resize(record.data_bytes);
  if (auto read = bytes_->read(record.data_offset, packed_); !read) return read;
  if (auto fault = unpack_chunk(compression, packed_, *record.fields.size, chunk_))
    return corrupt(record.offset, "the chunk that begins here cannot be unpacked: " + *fault);
  chunk_position_ = 0;
  chunk_offset_ = record.offset;
  ++chunks_;
  ++by_compression_[compression == "none" ? 0 : compression == "lz4" ? 1 : 2];
  return Done{};
}

Expected<bool> BagReader::read_chunk() {
  while (position_ < bytes_->size()) {
    auto record = read_record();
    if (!record) {
      position_ = bytes_->size();
      return forward_error(std::move(record));
    }
    if (record->fields.op == BagOp::kChunk) {
      if (auto unpacked = unpack(*record); !unpacked) {
        position_ = bytes_->size();
        return forward_error(std::move(unpacked));
      }
      return true;
    }
    // Messages stand in chunks; the index is not needed, and connections are repeated in them.
  }
  return false;
}

Status BagReader::add_connection(const BagFields& header, std::span<const std::byte> data,
                                 std::uint64_t offset) {
  const auto fields = parse_bag_fields(data);
  if (!header.conn || !fields || header.topic.empty() || fields->type.empty())
    return corrupt(offset, "a connection of this chunk does not tell its topic and type");
  if (connections_.contains(*header.conn)) {
    if (connections_.at(*header.conn).topic == header.topic) return Done{};
    return corrupt(offset, "two topics of this chunk share one number");
  }
  const bool is_modest =
      connections_.size() < kMaxConnections && data.size() < kMaxConnectionBytes &&
      header.topic.size() < kMostNameBytes && fields->type.size() < kMostNameBytes;
  if (!is_modest) return corrupt(offset, "the topics of this chunk cannot be");
  connections_.emplace(*header.conn,
                       BagConnection{*header.conn, std::string(header.topic),
                                     std::string(fields->type), std::string(fields->md5sum)});
  return Done{};
}

Expected<std::optional<BagMessage>> BagReader::next_in_chunk() {
  while (chunk_position_ < chunk_.size()) {
    ByteCursor cursor(std::span<const std::byte>(chunk_).subspan(chunk_position_));
    const auto header = cursor.take(cursor.read<std::uint32_t>());
    const auto data = cursor.take(cursor.read<std::uint32_t>());
    const std::size_t inside = chunk_position_;
    const auto fields = cursor.is_good() ? parse_bag_fields(header) : std::nullopt;
    if (!fields || !fields->op) {
      return corrupt(chunk_offset_,
                     fmt::format("{} bytes into the unpacked chunk that begins here, there is no "
                                 "record",
                                 inside));
    }
    chunk_position_ = chunk_.size() - cursor.left();
    if (fields->op == BagOp::kConnection) {
      if (auto added = add_connection(*fields, data, chunk_offset_); !added)
        return forward_error(std::move(added));
    } else if (fields->op == BagOp::kMessage) {
      const auto connection = fields->conn ? connections_.find(*fields->conn) : connections_.end();
      if (connection == connections_.end() || !fields->time)
        return corrupt(chunk_offset_, "a message in this chunk tells no known topic or no time");
      return BagMessage{&connection->second, *fields->time, data, chunk_offset_};
    }
  }
  return std::nullopt;
}

Expected<std::optional<BagMessage>> BagReader::read_next() {
  while (true) {
    auto message = next_in_chunk();
    if (!message || *message) return message;
    auto has_chunk = read_chunk();
    if (!has_chunk) {
      chunk_.clear();
      chunk_position_ = 0;
      return forward_error(std::move(has_chunk));
    }
    if (!*has_chunk) return std::nullopt;
  }
}

}  // namespace swiftlet
