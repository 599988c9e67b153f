// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "swiftlet/bag/bag_record.hpp"
#include "swiftlet/bag/byte_source.hpp"
#include "swiftlet/bag/recording_reader.hpp"
#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// Whether bytes begin as a ROS bag does, of this version of the format or another.
[[nodiscard]] bool has_bag_magic(std::span<const std::byte> start);
/// The same of a file; false if it cannot be read.
[[nodiscard]] bool is_bag_file(const std::filesystem::path& path);

/// Reads a ROS bag (format 2.0) from its beginning to its end, without its index: recordings that
/// were never closed can be read as far as they go.
///
/// Memory: one chunk packed and one unpacked, at most kMaxChunkBytes each, and the names of the
/// topics. Nothing is allocated on the word of the file alone. Time: that of the file's size; a
/// bzip2 that grows more than 64 times, beyond the first 16 MiB, is refused.
/// Source: wiki.ros.org/Bags/Format/2.0.
class BagReader final : public RecordingReader {
 public:
  /// Errors: kUnsupported for another version of the format, kCorruptInput if it is no bag.
  [[nodiscard]] static Expected<BagReader> open(ByteSourcePtr bytes);

  [[nodiscard]] const std::map<std::uint32_t, BagConnection>& connections() const override {
    return connections_;
  }
  [[nodiscard]] const std::string& name() const override { return bytes_->name(); }
  [[nodiscard]] RecordingInfo info() const override;

 protected:
  /// In the order of the file, which is that of writing.
  [[nodiscard]] Expected<std::optional<BagMessage>> read_next() override;
  void end() override;

 private:
  explicit BagReader(ByteSourcePtr bytes) : bytes_(std::move(bytes)) {}

  /// The next record of the file whose data are not skipped.
  struct FileRecord {
    BagFields fields;
    std::uint64_t offset;  ///< of the record
    std::uint64_t data_offset;
    std::uint32_t data_bytes;
  };
  [[nodiscard]] Expected<FileRecord> read_record();
  [[nodiscard]] Expected<bool> read_chunk();  // false at the end of the file
  [[nodiscard]] Status check_budget(const FileRecord& record);
  [[nodiscard]] Status unpack(const FileRecord& record);
  [[nodiscard]] Expected<std::optional<BagMessage>> next_in_chunk();
  [[nodiscard]] Status add_connection(const BagFields& header, std::span<const std::byte> data,
                                      std::uint64_t offset);
  [[nodiscard]] tl::unexpected<Error> corrupt(std::uint64_t offset, std::string what);

  ByteSourcePtr bytes_;
  std::uint64_t position_ = 0;
  std::uint64_t chunks_ = 0;
  std::array<std::uint64_t, 3> by_compression_{};    // none, lz4, bz2
  std::uint64_t bz2_packed_ = 0, bz2_unpacked_ = 0;  // bytes so far
  std::map<std::uint32_t, BagConnection> connections_;
  std::vector<std::byte> header_, packed_, chunk_;
  std::size_t chunk_position_ = 0;
  std::uint64_t chunk_offset_ = 0;
};

}  // namespace swiftlet
