// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/file/private_folder.hpp"
#include "swiftlet/store/map_file/sqlite.hpp"

namespace swiftlet {

/// Whether logs lie beside a map that must be taken into account to read it.
[[nodiscard]] bool has_logs(const std::filesystem::path& path);

/// Copies a map and its logs into `folder` and lets SQLite finish or undo there what a killed
/// writer had begun. Returns the copy: one file without logs. The map itself is not touched.
/// Errors: kIo (also if the folder has no room for it), kCorruptInput.
[[nodiscard]] Expected<std::filesystem::path> copy_recovered(const std::filesystem::path& path,
                                                             const PrivateFolder& folder);

/// Opens such a copy to read. It has no name any more, so that nothing is left of it at the end,
/// however that comes.
[[nodiscard]] Expected<sqlite::Database> open_recovered(const std::filesystem::path& path);

}  // namespace swiftlet
