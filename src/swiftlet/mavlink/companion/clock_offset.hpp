// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "swiftlet/base/time.hpp"

namespace swiftlet::mavlink {

/// By how much another's clock differs from ours, from answered questions (TIMESYNC). Of the last
/// kKept answers the one that took the shortest way counts: its error is at most half of that way.
/// A clock that has jumped is believed after kJumps answers in a row that agree on it.
/// Source: PX4, Timesync.cpp, for the formula.
class ClockOffset {
 public:
  static constexpr std::size_t kKept = 10;
  static constexpr std::size_t kJumps = 3;
  static constexpr Nanoseconds kLongestWay = std::chrono::milliseconds(100);
  static constexpr Nanoseconds kJump = std::chrono::milliseconds(50);

  /// An answer: when we asked, what the other's clock said, when the answer came.
  void add(Stamp asked, Stamp theirs, Stamp answered);

  /// Ours minus theirs; nullopt before the first answer.
  [[nodiscard]] std::optional<Nanoseconds> ours_minus_theirs() const;
  /// The way there and back of the answer that counts.
  [[nodiscard]] std::optional<Nanoseconds> round_trip() const;

 private:
  struct Answer {
    Nanoseconds offset, way;
  };
  [[nodiscard]] const Answer* best() const;

  std::array<Answer, kKept> answers_{};
  std::size_t count_ = 0;  // of all since the last jump
  std::size_t strange_ = 0;
};

}  // namespace swiftlet::mavlink
