// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <optional>

namespace swiftlet::mavlink {

/// Hands the newest value from one thread to one other; older ones that were not taken are gone.
/// Neither side waits for the other: of three places one is written, one read, and one changes
/// hands. REQUIRES: Value can be copied without allocating.
template <class Value>
class LatestValue {
 public:
  /// The writer's.
  void put(const Value& value) {
    places_[writing_] = value;
    writing_ =
        between_.exchange(static_cast<std::uint8_t>(writing_ | kIsNew), std::memory_order_acq_rel) &
        kPlace;
  }

  /// The reader's: what was put since the last call; nullopt if nothing was.
  [[nodiscard]] std::optional<Value> take() {
    if ((between_.load(std::memory_order_relaxed) & kIsNew) == 0) return std::nullopt;
    reading_ = between_.exchange(reading_, std::memory_order_acq_rel) & kPlace;
    return places_[reading_];
  }

 private:
  static constexpr std::uint8_t kPlace = 3, kIsNew = 4;
  std::array<Value, 3> places_{};
  std::atomic<std::uint8_t> between_{1};
  std::uint8_t writing_ = 0;  // the writer's
  std::uint8_t reading_ = 2;  // the reader's
};

}  // namespace swiftlet::mavlink
