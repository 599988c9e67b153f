// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/sqlite_uri.hpp"

#include <fmt/format.h>

#include <system_error>

namespace swiftlet {

std::string sqlite_uri(const std::filesystem::path& path, std::string_view options) {
  std::error_code none;
  std::string uri = "file://";
  for (const char c : std::filesystem::absolute(path, none).string()) {
    const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                          (c >= '0' && c <= '9') || c == '/' || c == '.' || c == '-' || c == '_';
    uri += is_plain ? std::string(1, c) : fmt::format("%{:02x}", static_cast<unsigned char>(c));
  }
  return uri + "?" + std::string(options);
}

}  // namespace swiftlet
