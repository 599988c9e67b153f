// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "swiftlet/base/expected.hpp"

namespace swiftlet {

/// The address of a source behind its kind: `PLACE?key=value&key=value`.
struct SourceAddress {
  std::string place;
  std::vector<std::pair<std::string, std::string>> options;
};

/// Errors: kUsage for an option without "=" or given twice.
[[nodiscard]] Expected<SourceAddress> parse_address(std::string_view rest, std::string_view kind);

/// The same where the place is a file or folder, whose name may hold a '?': what exists is the
/// place, the longest such name if there are several. Errors: those of parse_address().
[[nodiscard]] Expected<SourceAddress> parse_place_address(std::string_view rest,
                                                          std::string_view kind);

/// The parts of a list "a,b,c"; one empty part of an empty text.
[[nodiscard]] std::vector<std::string> split_list(std::string_view text);

/// The files that the address of a source names, KIND:FILE[,FILE...][?...]; those that exist.
[[nodiscard]] std::vector<std::filesystem::path> existing_files(std::string_view address);

/// Adds an option to an address.
[[nodiscard]] std::string with_option(std::string address, std::string_view key,
                                      std::string_view value);

/// The error for an option that a kind of source does not know, or whose value cannot be meant.
[[nodiscard]] tl::unexpected<Error> bad_option(std::string_view kind, std::string_view key,
                                               std::string_view value, std::string known);

}  // namespace swiftlet
