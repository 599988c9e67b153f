// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/address_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <system_error>

namespace swiftlet {

namespace {

/// Splits behind the first `mark` bytes.
Expected<SourceAddress> split_at(std::string_view rest, std::size_t mark, std::string_view kind) {
  SourceAddress address{std::string(rest.substr(0, mark)), {}};
  std::string_view query = rest.substr(std::min(mark + 1, rest.size()));
  while (!query.empty()) {
    const std::string_view pair = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), pair.size() + 1));
    const std::size_t equals = pair.find('=');
    const std::string key(pair.substr(0, equals));
    const bool is_new = std::ranges::none_of(
        address.options, [&](const auto& option) { return option.first == key; });
    if (equals == std::string_view::npos || !is_new) {
      return fail(
          ErrorCode::kUsage, std::string(kind),
          fmt::format("the option '{}' {}", pair, is_new ? "has no value" : "was given before"),
          "options are written ?key=value&key=value");
    }
    address.options.emplace_back(key, std::string(pair.substr(equals + 1)));
  }
  return address;
}

}  // namespace

Expected<SourceAddress> parse_address(std::string_view rest, std::string_view kind) {
  return split_at(rest, std::min(rest.find('?'), rest.size()), kind);
}

Expected<SourceAddress> parse_place_address(std::string_view rest, std::string_view kind) {
  std::error_code unreadable;
  for (std::size_t mark = rest.size(); mark != std::string_view::npos && mark > 0;
       mark = rest.rfind('?', mark - 1)) {
    if (std::filesystem::exists(rest.substr(0, mark), unreadable))
      return split_at(rest, mark, kind);
  }
  return parse_address(rest, kind);
}

std::vector<std::string> split_list(std::string_view text) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    parts.emplace_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

std::vector<std::filesystem::path> existing_files(std::string_view address) {
  const std::size_t kind = address.find(':');  // npos + 1 is 0: an address without a kind
  const auto parsed = parse_place_address(address.substr(kind + 1), address.substr(0, kind));
  std::vector<std::filesystem::path> files;
  if (!parsed) return files;
  for (const std::string& part : split_list(parsed->place)) {
    std::error_code unreadable;
    if (std::filesystem::is_regular_file(part, unreadable)) files.emplace_back(part);
  }
  return files;
}

std::string with_option(std::string address, std::string_view key, std::string_view value) {
  const char joint = address.find('?') == std::string::npos ? '?' : '&';
  return fmt::format("{}{}{}={}", address, joint, key, value);
}

tl::unexpected<Error> bad_option(std::string_view kind, std::string_view key,
                                 std::string_view value, std::string known) {
  return fail(ErrorCode::kUsage, std::string(kind),
              fmt::format("the option '{}={}' cannot be meant", key, value),
              "known are: " + std::move(known));
}

}  // namespace swiftlet
