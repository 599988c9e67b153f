// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace swiftlet {

/// The name by which SQLite opens a file with options, as in "file:///a%20map.swl?immutable=1":
/// nothing in the path may look like an option. `options`: "immutable=1", several joined by "&".
[[nodiscard]] std::string sqlite_uri(const std::filesystem::path& path, std::string_view options);

}  // namespace swiftlet
