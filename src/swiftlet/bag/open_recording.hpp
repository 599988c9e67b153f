// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "swiftlet/bag/recording_reader.hpp"

namespace swiftlet {

/// Kinds of files that hold recordings.
enum class RecordingKind : std::uint8_t {
  kNone,
  kRosBag,  ///< ROS 1
  kMcap,    ///< ROS 2's default, and others'
  kSqlite,  ///< ROS 2's other
  kZstd,    ///< one of these, packed as a whole
};

/// What a file may be by its first bytes (16 suffice), never by its name: any database begins as
/// kSqlite, anything packed as kZstd.
[[nodiscard]] RecordingKind recording_kind(std::span<const std::byte> start);
/// The same, looking into databases and what is packed, too. False for what cannot be read.
[[nodiscard]] bool is_recording(const std::filesystem::path& file);

/// Opens a recording: a file of any kind, or a folder with the files that one recording was split
/// into. What was packed as a whole is unpacked into a temporary file first.
/// Errors: kNotFound, kIo; kCorruptInput if it is no recording; those of the kind's reader.
[[nodiscard]] Expected<RecordingReaderPtr> open_recording(const std::filesystem::path& path);

}  // namespace swiftlet
