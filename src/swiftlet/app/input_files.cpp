// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/input_files.hpp"

#include <algorithm>
#include <system_error>

namespace swiftlet::app {

std::vector<std::filesystem::path> input_files(std::string_view address) {
  const std::size_t kind = address.find(':');
  std::string_view place = kind == std::string_view::npos ? address : address.substr(kind + 1);
  place = place.substr(0, place.find('?'));
  std::vector<std::filesystem::path> files;
  while (!place.empty()) {
    const std::size_t end = std::min(place.find(','), place.size());
    const std::filesystem::path file(place.substr(0, end));
    std::error_code unreadable;
    if (std::filesystem::is_regular_file(file, unreadable)) files.push_back(file);
    place.remove_prefix(std::min(end + 1, place.size()));
  }
  return files;
}

}  // namespace swiftlet::app
