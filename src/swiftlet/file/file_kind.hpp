// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// Kinds of files that the commands tell apart, by what is in them and never by their name.
enum class FileKind : std::uint8_t {
  kMap,      ///< a Swiftlet map
  kOctomap,  ///< .bt or .ot
  kBag,      ///< a recording of ROS
  kText,     ///< perhaps a config, a rig or a scene
  kOther,    ///< something that we know, or not, but do not read
};

struct FileFacts {
  FileKind kind = FileKind::kOther;
  std::string what;    ///< "a PNG picture", "it is ..." may stand before it
  std::string remedy;  ///< what to do with such a file instead; may be empty
};

/// What a file is, by its first bytes; look_at_file_or_recording() knows more recordings. Errors:
/// those of read_head().
[[nodiscard]] Expected<FileFacts> look_at_file(const std::filesystem::path& path);

/// The error of a command that wants something else: "it is a PNG picture, not a map".
[[nodiscard]] Error wrong_kind(const std::filesystem::path& path, const FileFacts& facts,
                               std::string_view wanted);

}  // namespace swiftlet
