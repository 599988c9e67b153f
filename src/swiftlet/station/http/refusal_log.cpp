// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/station/http/refusal_log.hpp"

#include <fmt/format.h>

#include <utility>

namespace swiftlet::station {

std::optional<std::string> RefusalLog::note(const std::string& address, const std::string& why,
                                            Time now) {
  if (!lines_.is_open(now)) {
    ++left_out_;
    return std::nullopt;
  }
  lines_.spend(1.0);
  std::string line = fmt::format("turned away {}: {}", address, why);
  if (const auto more = std::exchange(left_out_, 0); more > 0) {
    line += fmt::format(" ({} more since the line before)", more);
  }
  return line;
}

}  // namespace swiftlet::station
