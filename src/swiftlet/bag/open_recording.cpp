// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/open_recording.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <system_error>
#include <utility>

#include "swiftlet/bag/bag_reader.hpp"
#include "swiftlet/bag/byte_source.hpp"
#include "swiftlet/bag/chunk_codec.hpp"
#include "swiftlet/bag/mcap/mcap_reader.hpp"
#include "swiftlet/bag/rosbag2/rosbag2_reader.hpp"
#include "swiftlet/bag/rosbag2/split_reader.hpp"
#include "swiftlet/bag/rosbag2/unpacked_file.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kStartBytes = 16;

Expected<RecordingKind> look_at(const ByteSource& bytes) {
  std::array<std::byte, kStartBytes> start{};
  const auto head = std::span(start).first(std::min<std::uint64_t>(start.size(), bytes.size()));
  if (auto read = bytes.read(0, head); !read) return forward_error(std::move(read));
  return recording_kind(head);
}

template <class Reader>
Expected<RecordingReaderPtr> as_pointer(Expected<Reader>&& reader) {
  if (!reader) return forward_error(std::move(reader));
  return std::make_unique<Reader>(std::move(*reader));
}

/// Bytes of an unpacked copy under the name of what was packed, which they keep.
class UnpackedBytes final : public ByteSource {
 public:
  UnpackedBytes(ByteSourcePtr bytes, std::string name, std::shared_ptr<const UnpackedFile> copy)
      : bytes_(std::move(bytes)), name_(std::move(name)), copy_(std::move(copy)) {}
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::uint64_t size() const override { return bytes_->size(); }
  [[nodiscard]] Status read(std::uint64_t offset, std::span<std::byte> out) const override {
    return bytes_->read(offset, out);
  }

 private:
  ByteSourcePtr bytes_;
  std::string name_;
  std::shared_ptr<const UnpackedFile> copy_;
};

Expected<RecordingReaderPtr> open_kind(RecordingKind kind, ByteSourcePtr bytes,
                                       const std::filesystem::path& file) {
  const std::string name = bytes->name();
  switch (kind) {
    case RecordingKind::kRosBag:
      return as_pointer(BagReader::open(std::move(bytes)));
    case RecordingKind::kMcap:
      return as_pointer(McapReader::open(std::move(bytes)));
    case RecordingKind::kSqlite:
      return as_pointer(Rosbag2Reader::open(file, name));
    default:
      return fail(
          ErrorCode::kCorruptInput, name,
          bytes->size() == 0 ? "it is empty" : "it is no recording of ROS",
          "recordings are ROS 1 bags, MCAP files and the SQLite files of ROS 2, or a folder "
          "with them");
  }
}

Expected<RecordingReaderPtr> open_packed(const std::filesystem::path& path) {
  auto copy = unpacked_copy_of(path);
  if (!copy) return forward_error(std::move(copy));
  const std::filesystem::path file = (*copy)->path();
  auto inner = open_file_bytes(file);
  if (!inner) return forward_error(std::move(inner));
  auto bytes = std::make_unique<UnpackedBytes>(std::move(*inner), path.string(), std::move(*copy));
  const auto kind = look_at(*bytes);
  if (!kind) return tl::make_unexpected(kind.error());
  return open_kind(*kind, std::move(bytes), file);
}

}  // namespace

RecordingKind recording_kind(std::span<const std::byte> start) {
  if (has_bag_magic(start)) return RecordingKind::kRosBag;
  if (has_mcap_magic(start)) return RecordingKind::kMcap;
  if (has_sqlite_magic(start)) return RecordingKind::kSqlite;
  return is_zstd(start) ? RecordingKind::kZstd : RecordingKind::kNone;
}

bool is_recording(const std::filesystem::path& file) {
  const auto bytes = open_file_bytes(file);
  if (!bytes) return false;
  const RecordingKind kind = look_at(**bytes).value_or(RecordingKind::kNone);
  if (kind == RecordingKind::kSqlite) return Rosbag2Reader::open(file, file.string()).has_value();
  if (kind != RecordingKind::kZstd) return kind != RecordingKind::kNone;
  const RecordingKind inner = recording_kind(unpacked_start(**bytes, kStartBytes));
  return inner != RecordingKind::kNone && inner != RecordingKind::kZstd;
}

Expected<RecordingReaderPtr> open_recording(const std::filesystem::path& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) return as_pointer(SplitReader::open(path));
  auto bytes = open_file_bytes(path);
  if (!bytes) return forward_error(std::move(bytes));
  const auto kind = look_at(**bytes);
  if (!kind) return tl::make_unexpected(kind.error());
  if (*kind == RecordingKind::kZstd) return open_packed(path);
  return open_kind(*kind, std::move(*bytes), path);
}

}  // namespace swiftlet
