// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// The whole content of a file. Errors: kNotFound, kIo with the reason of the operating system.
[[nodiscard]] Expected<std::string> read_file(const std::filesystem::path& path);

/// The words of a text, separated by blanks, tabs or line ends. They point into `text`.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);

/// A line that says something: neither blank nor a '#' comment.
struct TextRow {
  std::size_t line;  ///< counted from 1, as editors do
  std::vector<std::string_view> words;
};

/// The rows of a list file. The words point into `text`.
[[nodiscard]] std::vector<TextRow> rows_of(std::string_view text);

/// A decimal number in any notation, also "nan" and "inf"; nullopt unless the whole word is one.
/// Independent of the locale.
[[nodiscard]] std::optional<double> parse_number(std::string_view word);

}  // namespace swiftlet
