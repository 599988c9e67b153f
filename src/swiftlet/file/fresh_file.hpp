// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <span>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// Makes a file beside `path` under a name that nobody can guess and so nobody can have prepared;
/// no link is followed and no file is replaced. It holds `bytes`, and the disk has them.
/// Returns its name. Errors: kIo naming `path`; then there is none.
[[nodiscard]] Expected<std::filesystem::path> make_fresh_file(const std::filesystem::path& path,
                                                              std::span<const unsigned char> bytes);

/// Gives `from` the name `to` unless that is taken. Errors: kUsage if it is; kIo.
[[nodiscard]] Status rename_if_free(const std::filesystem::path& from,
                                    const std::filesystem::path& to);

}  // namespace swiftlet
