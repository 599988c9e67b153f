// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "swiftlet/base/number_text.hpp"

namespace swiftlet {

/// The words of a text, separated by blanks, tabs or line ends. They point into `text`.
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text);

/// A line that says something: neither blank nor a '#' comment.
struct TextRow {
  std::size_t line;  ///< counted from 1, as editors do
  std::vector<std::string_view> words;
};

/// The rows of a list file. The words point into `text`.
[[nodiscard]] std::vector<TextRow> rows_of(std::string_view text);

}  // namespace swiftlet
