// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/text_file.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet {

std::vector<std::string_view> words_of(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n\v\f";
  std::vector<std::string_view> words;
  for (std::size_t begin = text.find_first_not_of(kBlanks); begin != std::string_view::npos;) {
    const std::size_t end = std::min(text.find_first_of(kBlanks, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = text.find_first_not_of(kBlanks, end);
  }
  return words;
}

std::vector<TextRow> rows_of(std::string_view text) {
  std::vector<TextRow> rows;
  for (std::size_t line = 1; !text.empty(); ++line) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    auto words = words_of(text.substr(0, end));
    if (!words.empty() && !words.front().starts_with('#')) rows.push_back({line, std::move(words)});
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return rows;
}

}  // namespace swiftlet
