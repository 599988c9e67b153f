// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/bag/byte_source.hpp"
#include "swiftlet/bag/mcap/mcap_records.hpp"
#include "swiftlet/bag/mcap/mcap_topics.hpp"
#include "swiftlet/bag/recording_reader.hpp"

namespace swiftlet {

/// Whether bytes begin as an MCAP file does.
[[nodiscard]] bool has_mcap_magic(std::span<const std::byte> start);

/// Reads an MCAP file from its beginning to the end of its data, in chunks or not, without its
/// index: one whose writer was killed is read as far as it goes, and its last chunk, if that is not
/// whole, is an error at the end.
///
/// Memory: one chunk packed and one unpacked, at most kMaxChunkBytes each, and the names of the
/// topics. Nothing is allocated on the word of the file alone. Checksums are verified where the
/// writer has computed them: of each chunk, and of the data of a file without chunks.
/// Source: mcap.dev/spec.
class McapReader final : public RecordingReader {
 public:
  /// Errors: kUnsupported for another version of the format, kCorruptInput if it is no MCAP file.
  [[nodiscard]] static Expected<McapReader> open(ByteSourcePtr bytes);

  [[nodiscard]] const std::map<std::uint32_t, BagConnection>& connections() const override {
    return topics_.channels();
  }
  [[nodiscard]] const std::string& name() const override { return bytes_->name(); }
  [[nodiscard]] RecordingInfo info() const override;

 protected:
  [[nodiscard]] Expected<std::optional<BagMessage>> read_next() override;
  void end() override;

 private:
  explicit McapReader(ByteSourcePtr bytes) : bytes_(std::move(bytes)) {}

  using MessageOrNone = Expected<std::optional<BagMessage>>;
  struct FileRecord {
    mcap::RecordHead head;
    std::uint64_t offset;  // of the record
  };
  [[nodiscard]] Expected<std::optional<FileRecord>> next_record();
  [[nodiscard]] Expected<mcap::Body> body_of(const FileRecord& record, std::uint64_t most_bytes);
  [[nodiscard]] Status pass_over(const FileRecord& record);
  [[nodiscard]] MessageOrNone next_in_file();
  [[nodiscard]] MessageOrNone look_at(const FileRecord& record);
  [[nodiscard]] MessageOrNone next_in_chunk();
  [[nodiscard]] MessageOrNone take(mcap::Op op, mcap::Body body, std::uint64_t offset);
  [[nodiscard]] Status begin_chunk(const FileRecord& record);
  [[nodiscard]] Status unpack(const mcap::Chunk& chunk, std::uint64_t offset);
  [[nodiscard]] Status check_data(const FileRecord& record);
  [[nodiscard]] MessageOrNone message_of(mcap::Body body, std::uint64_t offset);
  [[nodiscard]] tl::unexpected<Error> corrupt(std::uint64_t offset, std::string what);
  [[nodiscard]] tl::unexpected<Error> cut_off(std::uint64_t offset, std::string what);

  ByteSourcePtr bytes_;
  std::uint64_t position_ = 0;
  std::string profile_;
  bool is_closed_ = false;
  std::uint64_t chunks_ = 0;
  std::set<std::string> compression_;
  std::uint64_t packed_bytes_ = 0, unpacked_bytes_ = 0;  // of chunks so far
  std::optional<std::uint32_t> data_crc_;                // of the file so far, if it has no chunks
  mcap::McapTopics topics_;
  std::vector<std::byte> body_, unpacked_;
  mcap::Body chunk_{};  // what is left of it, in body_ or unpacked_
  std::uint64_t chunk_offset_ = 0;
};

}  // namespace swiftlet
