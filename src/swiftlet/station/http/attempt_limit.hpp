// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "swiftlet/station/state/token_bucket.hpp"

namespace swiftlet::station {

/// How often each address may guess at the token: ten times at once, then once in two seconds.
/// Knows a bounded number of addresses; past that it forgets the one that has been quiet longest.
/// Thread safety: the station's thread alone.
class AttemptLimit {
 public:
  using Time = TokenBucket::Clock::time_point;
  static constexpr std::size_t kAddresses = 1024;
  static constexpr double kTriesPerS = 0.5;
  static constexpr double kTriesAtOnce = 10.0;

  /// Whether this address may guess now.
  [[nodiscard]] bool may_try(const std::string& address, Time now);
  /// It has guessed wrong.
  void failed(const std::string& address, Time now);
  [[nodiscard]] std::size_t addresses() const { return known_.size(); }

 private:
  struct Entry {
    TokenBucket tries;
    Time last;
  };
  std::map<std::string, Entry> known_;  // who has guessed wrong
};

}  // namespace swiftlet::station
