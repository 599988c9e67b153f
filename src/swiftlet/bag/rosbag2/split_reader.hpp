// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/bag/recording_reader.hpp"

namespace swiftlet {

/// Reads the files that a recorder has split one recording into as if they were one.
/// Memory: that of one of the readers.
class SplitReader final : public RecordingReader {
 public:
  /// The files that files_of_recording() finds. Errors: its own, and those of opening the first.
  [[nodiscard]] static Expected<SplitReader> open(const std::filesystem::path& folder);

  [[nodiscard]] const std::map<std::uint32_t, BagConnection>& connections() const override {
    return connections_;
  }
  [[nodiscard]] const std::string& name() const override { return name_; }
  [[nodiscard]] std::string place_of(const BagMessage& message) const override;
  [[nodiscard]] RecordingInfo info() const override;

 protected:
  [[nodiscard]] Expected<std::optional<BagMessage>> read_next() override;
  void end() override;

 private:
  SplitReader(std::string name, std::vector<std::filesystem::path> files)
      : name_(std::move(name)), files_(std::move(files)) {}
  [[nodiscard]] Status open_next();
  void adopt_connections();
  [[nodiscard]] const BagConnection& own(const BagConnection& theirs);

  std::string name_;
  std::vector<std::filesystem::path> files_;
  std::size_t opened_ = 0;
  RecordingReaderPtr part_;  // the file that is being read; null: none is left
  RecordingInfo before_;     // of the files that are read
  std::map<std::uint32_t, BagConnection> connections_;
  std::map<std::uint32_t, std::uint32_t> own_number_;  // by that in part_
};

}  // namespace swiftlet
