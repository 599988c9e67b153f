// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "swiftlet/station/state/token_bucket.hpp"

namespace swiftlet::station {

/// Lines that say whom the station turned away and why: a few at once, then one in five seconds,
/// so that nobody fills a log from afar. What was left out is counted in the next line.
/// Thread safety: the station's thread alone.
class RefusalLog {
 public:
  using Time = TokenBucket::Clock::time_point;
  static constexpr double kLinesPerS = 0.2;
  static constexpr double kLinesAtOnce = 3.0;

  explicit RefusalLog(Time now) : lines_(kLinesPerS, kLinesAtOnce, now) {}

  /// The line to write, or nullopt where there have been enough of late.
  [[nodiscard]] std::optional<std::string> note(const std::string& address, const std::string& why,
                                                Time now);

 private:
  TokenBucket lines_;
  std::size_t left_out_ = 0;
};

}  // namespace swiftlet::station
