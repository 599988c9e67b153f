// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// The files of the one recording that a folder holds, in order: those that its metadata.yaml lists
/// (`ros2 bag record` writes it at the end), or without it all recordings by the number at the end
/// of their names. Empty if the metadata list none. Errors: kNotFound if there is none, or one is
/// missing; kUsage naming them if there are several; those of reading the metadata.
[[nodiscard]] Expected<std::vector<std::filesystem::path>> files_of_recording(
    const std::filesystem::path& folder);

/// The names that the text of a metadata.yaml lists. Errors: kInvalidConfig, kCorruptInput at
/// `place`.
[[nodiscard]] Expected<std::vector<std::string>> files_in_metadata(std::string_view text,
                                                                   const std::string& place);

}  // namespace swiftlet
