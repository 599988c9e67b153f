// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

// The most that a file of a kind may hold [bytes]. What is longer is no such file but something
// else, given by mistake or in bad faith.
inline constexpr std::size_t kMostSettingsBytes = std::size_t{1} << 24;  ///< config, rig, scene
inline constexpr std::size_t kMostListBytes = std::size_t{1} << 28;      ///< 20 h of poses at 30 Hz
inline constexpr std::size_t kMostImageBytes = std::size_t{1} << 26;
inline constexpr std::size_t kMostMatrixBytes = std::size_t{1} << 16;

/// Whether a path leads to a regular file. A pipe or a device may keep its reader waiting, or have
/// no end; asking does not open it.
/// Errors: kNotFound; kIo naming what it is instead.
[[nodiscard]] Status check_regular_file(const std::filesystem::path& path);

/// The whole content of a regular file of at most `most_bytes`, byte for byte.
/// Errors: those of check_regular_file(); kIo with the reason of the operating system; kUnsupported
/// if it is longer. Memory: that of the content.
[[nodiscard]] Expected<std::string> read_file(const std::filesystem::path& path,
                                              std::size_t most_bytes);

/// The first bytes of a regular file, at most `most_bytes`, whatever its length.
/// Errors: those of check_regular_file(); kIo with the reason of the operating system.
[[nodiscard]] Expected<std::string> read_head(const std::filesystem::path& path,
                                              std::size_t most_bytes);

/// As read_file() of a text, as UTF-8 and without the byte order mark that some editors put before
/// it; a mark of UTF-16 has the text turned into UTF-8.
[[nodiscard]] Expected<std::string> read_text_file(const std::filesystem::path& path,
                                                   std::size_t most_bytes);

}  // namespace swiftlet
