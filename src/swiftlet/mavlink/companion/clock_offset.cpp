// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/clock_offset.hpp"

#include <algorithm>
#include <cstdlib>

namespace swiftlet::mavlink {

void ClockOffset::add(Stamp asked, Stamp theirs, Stamp answered) {
  const Nanoseconds way = answered - asked;
  if (way < Nanoseconds(0) || way > kLongestWay) return;
  // Halves first: the sum of two times since 1970 would not fit.
  const Nanoseconds offset = (asked + way / 2) - theirs;
  const Answer* const known = best();
  if (known != nullptr && std::chrono::abs(offset - known->offset) > kJump) {
    if (++strange_ < kJumps) return;
    count_ = 0;
  }
  strange_ = 0;
  answers_[count_++ % kKept] = {offset, way};
}

const ClockOffset::Answer* ClockOffset::best() const {
  if (count_ == 0) return nullptr;
  const auto* const end = answers_.data() + std::min(count_, kKept);
  return std::min_element(answers_.data(), end,
                          [](const Answer& a, const Answer& b) { return a.way < b.way; });
}

std::optional<Nanoseconds> ClockOffset::ours_minus_theirs() const {
  const Answer* const answer = best();
  return answer == nullptr ? std::nullopt : std::optional(answer->offset);
}

std::optional<Nanoseconds> ClockOffset::round_trip() const {
  const Answer* const answer = best();
  return answer == nullptr ? std::nullopt : std::optional(answer->way);
}

}  // namespace swiftlet::mavlink
