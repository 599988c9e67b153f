// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// Whether two names lead to one file, be it through hard or symbolic links.
[[nodiscard]] bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Whether a file says in its first bytes that it is a Swiftlet map; its name does not matter.
[[nodiscard]] bool is_map_file(const std::filesystem::path& path);

/// 16 hexadecimal digits that nobody can guess, for names of temporary files.
[[nodiscard]] std::string unguessable_digits();

/// Renames a file, and never puts it over another. Errors: kUsage if `to` exists; kIo.
[[nodiscard]] Status rename_to_new(const std::filesystem::path& from,
                                   const std::filesystem::path& to);

/// Waits until the disk has what a folder says of its files: a rename that a power cut cannot undo.
void settle_folder_of(const std::filesystem::path& path);

}  // namespace swiftlet
