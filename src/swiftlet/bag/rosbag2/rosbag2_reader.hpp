// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "swiftlet/bag/recording_reader.hpp"

namespace swiftlet {

/// Whether bytes begin as an SQLite database does.
[[nodiscard]] bool has_sqlite_magic(std::span<const std::byte> start);

/// Reads the SQLite files of ROS 2's recorder (.db3), of every version of its tables, from the
/// first row to the last. A file whose recorder was killed is read with its log, if that lies
/// beside it.
///
/// Memory: the page cache of SQLite and one message. What the database holds beside its tables of
/// messages (views, triggers) is never run.
/// Source: rosbag2_storage_sqlite3 of ros2/rosbag2.
class Rosbag2Reader final : public RecordingReader {
 public:
  /// `name`: what messages call it. Errors: kCorruptInput if it is no database or none of rosbag2,
  /// kIo.
  [[nodiscard]] static Expected<Rosbag2Reader> open(const std::filesystem::path& path,
                                                    const std::string& name);
  Rosbag2Reader(Rosbag2Reader&&) noexcept;
  Rosbag2Reader& operator=(Rosbag2Reader&&) = delete;
  ~Rosbag2Reader() override;

  [[nodiscard]] const std::map<std::uint32_t, BagConnection>& connections() const override {
    return topics_;
  }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::string place_of(const BagMessage& message) const override;
  [[nodiscard]] RecordingInfo info() const override;

 protected:
  [[nodiscard]] Expected<std::optional<BagMessage>> read_next() override;
  void end() override;

 private:
  class Rows;
  Rosbag2Reader(std::string name, std::unique_ptr<Rows> rows);
  [[nodiscard]] Status read_topics();

  std::string name_;
  std::unique_ptr<Rows> rows_;  // null at the end
  std::map<std::uint32_t, BagConnection> topics_;
};

}  // namespace swiftlet
