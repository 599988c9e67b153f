// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// Makes a folder and those it lies in; one that is there is fine. Errors: kIo with the reason.
[[nodiscard]] Status make_folder(const std::string& folder);

/// Writes a text file, whole or not at all. Errors: kIo with the reason.
[[nodiscard]] Status write_text(const std::filesystem::path& path, std::string_view text);

}  // namespace swiftlet
