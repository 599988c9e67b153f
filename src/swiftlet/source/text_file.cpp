// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/text_file.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <system_error>

#include "swiftlet/base/number_text.hpp"

namespace swiftlet {

Expected<std::string> read_file(const std::filesystem::path& path) {
  std::error_code unreadable;
  const auto kind = std::filesystem::status(path, unreadable).type();
  if (kind == std::filesystem::file_type::not_found)
    return fail(ErrorCode::kNotFound, path.string(), "there is no such file");
  if (kind == std::filesystem::file_type::directory)
    return fail(ErrorCode::kIo, path.string(), "it is a folder, not a file");

  errno = 0;
  std::ifstream file(path, std::ios::binary);
  std::string content{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.is_open() || file.bad())
    return fail(ErrorCode::kIo, path.string(),
                std::string("cannot be read: ") + std::generic_category().message(errno));
  return content;
}

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

std::optional<double> parse_number(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);  // from_chars knows only the minus
  return number_from<double>(word);
}

}  // namespace swiftlet
