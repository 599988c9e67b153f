// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/file/file_kind.hpp"

namespace swiftlet {

/// As look_at_file(), with what a look inside tells: recordings in databases, packed ones, and
/// folders with the files of one. Errors: those of look_at_file(), and of files_of_recording() if
/// the folder holds recordings.
[[nodiscard]] Expected<FileFacts> look_at_file_or_recording(const std::filesystem::path& path);

}  // namespace swiftlet
