// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/station/http/access.hpp"

namespace swiftlet::station {

/// A file of the page, compressed with gzip; linked into the program.
struct PageFile {
  std::string_view path;  ///< "/index.html"
  std::string_view mime;
  std::span<const std::uint8_t> gzip;
};
/// The built page; empty in a build without one.
[[nodiscard]] std::span<const PageFile> page_files();

/// What a request asks for.
struct HttpQuestion {
  std::string_view method;
  Credentials credentials;
  std::string_view site{};  ///< header Sec-Fetch-Site: what page is behind it, if a browser asks
};

/// What it gets.
struct HttpAnswer {
  int status = 200;
  std::vector<std::pair<std::string, std::string>> headers{};
  std::span<const std::uint8_t> body{};
  std::string text{};   ///< the body instead, where it is not linked into the program
  bool is_map = false;  ///< the body is to be the map file, which has to be made first
};

/// A line for people, with further headers. Says nothing of the map or of what runs here.
[[nodiscard]] HttpAnswer plain_answer(
    int status, std::string_view line,
    std::vector<std::pair<std::string, std::string>> headers = {});
/// Why a request is refused and what to do. REQUIRES: verdict != kAllowed
[[nodiscard]] HttpAnswer refusal(Verdict verdict, const Credentials& who);
/// There is no room at the moment.
[[nodiscard]] HttpAnswer busy_answer(std::string_view what);

/// Where the map file is to be had.
inline constexpr std::string_view kMapPath = "/map.swl";

/// The answer to a plain request (not one for a WebSocket). Every answer forbids the page to load
/// or reach anything but this server.
[[nodiscard]] HttpAnswer answer(const AccessRules& rules, const HttpQuestion& question,
                                std::span<const PageFile> files);

}  // namespace swiftlet::station
