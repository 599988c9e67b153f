// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>

namespace swiftlet::station {

/// Lets so much through a second on average, and a little more at once. The caller brings the time.
class TokenBucket {
 public:
  using Clock = std::chrono::steady_clock;

  TokenBucket() = default;  ///< without a limit
  TokenBucket(double per_second, double burst, Clock::time_point now)
      : per_second_(per_second), burst_(burst), tokens_(burst), last_(now) {}

  /// Whether something may go now. What it costs is known only afterwards, see spend().
  [[nodiscard]] bool is_open(Clock::time_point now) {
    if (per_second_ <= 0.0) return true;
    const double passed_s = std::chrono::duration<double>(now - last_).count();
    tokens_ = std::min(burst_, tokens_ + std::max(0.0, passed_s) * per_second_);
    last_ = now;
    return tokens_ > 0.0;
  }
  /// May run into debt, which later calls of is_open() wait for.
  void spend(double amount) {
    if (per_second_ > 0.0) tokens_ -= amount;
  }

 private:
  double per_second_ = 0.0;  // 0: no limit
  double burst_ = 0.0;
  double tokens_ = 0.0;
  Clock::time_point last_{};
};

}  // namespace swiftlet::station
