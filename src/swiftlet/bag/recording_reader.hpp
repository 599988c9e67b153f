// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "swiftlet/bag/bag_message.hpp"
#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// How a recording was written, as far as it has been read.
struct RecordingInfo {
  std::string format;                   ///< "ROS bag 2.0", "MCAP", "rosbag2 SQLite"
  std::uint64_t chunks = 0;             ///< of several messages each
  std::set<std::string> compression{};  ///< "none", "lz4", "bz2", "zstd"; empty without chunks
  std::uint64_t files = 1;
  bool is_closed = true;  ///< false where the writer was killed; nobody knows of ROS 1
};

/// Reads the messages of a recording from its beginning to its end, in the order of writing,
/// whatever kind of file it is. See open_recording().
/// Memory: bounded, whatever the size of the file and whatever it says of itself.
class RecordingReader {
 public:
  virtual ~RecordingReader() = default;

  /// The next message; nullopt at the end. Messages that the recorder packed one by one come out
  /// unpacked.
  /// Errors: kCorruptInput with the place where it is wrong, kIo. The reader is then at its end.
  [[nodiscard]] Expected<std::optional<BagMessage>> next();

  /// All topics seen so far, by number.
  [[nodiscard]] virtual const std::map<std::uint32_t, BagConnection>& connections() const = 0;
  /// What messages call the recording: its path.
  [[nodiscard]] virtual const std::string& name() const = 0;
  /// "camera.bag: byte 4117 (/depth)", for messages about a message.
  [[nodiscard]] virtual std::string place_of(const BagMessage& message) const;
  [[nodiscard]] virtual RecordingInfo info() const = 0;

  /// Bytes of messages so far, unpacked: how far the reader has come.
  [[nodiscard]] std::uint64_t bytes_read() const { return bytes_read_; }

 protected:
  RecordingReader() = default;
  RecordingReader(RecordingReader&&) = default;
  RecordingReader& operator=(RecordingReader&&) = default;
  /// As next(), with messages as they were recorded.
  [[nodiscard]] virtual Expected<std::optional<BagMessage>> read_next() = 0;
  /// No message comes after this.
  virtual void end() = 0;

 private:
  std::uint64_t bytes_read_ = 0;
  std::uint64_t packed_bytes_ = 0, unpacked_bytes_ = 0;  // of messages that were packed
  std::vector<std::byte> unpacked_;
};

using RecordingReaderPtr = std::unique_ptr<RecordingReader>;

}  // namespace swiftlet
