// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/stamp_judge.hpp"

#include <algorithm>
#include <utility>

namespace swiftlet {
namespace {

constexpr Nanoseconds kLate = std::chrono::milliseconds(250);  // samples overtake each other
constexpr Nanoseconds kPause = std::chrono::seconds(1);
constexpr int kPeriods = 20;
constexpr Nanoseconds kSlowest = std::chrono::minutes(10);  // of streams that come evenly
constexpr Nanoseconds kSilence = std::chrono::minutes(10);  // longer ones look like a set clock
constexpr Nanoseconds kSetAhead = std::chrono::hours(1);

/// b - a, at the end of the scale where that would not fit.
Nanoseconds from_to(Stamp a, Stamp b) {
  std::int64_t ns = 0;
  if (__builtin_sub_overflow(b.ns, a.ns, &ns))
    return a < b ? Nanoseconds::max() : -Nanoseconds::max();
  return Nanoseconds(ns);
}

/// Whether two samples of any stream may follow each other.
bool is_near(Stamp before, Stamp stamp) {
  const Nanoseconds step = from_to(before, stamp);
  return step >= -kLate && step <= kPause;
}

}  // namespace

Nanoseconds StampJudge::limit() const { return std::max(kPause, kPeriods * period_); }

bool StampJudge::goes_on(Stamp stamp) const {
  const Nanoseconds step = from_to(*last_, stamp);
  return step >= -kLate && step <= limit();
}

/// Whether the two that are held and a third are of one stream.
bool StampJudge::agree(Stamp third) const {
  const Nanoseconds first = from_to(held_first_, held_last_), second = from_to(held_last_, third);
  const auto [shorter, longer] = std::minmax(first, second);
  if (shorter <= Nanoseconds(0)) return false;
  return longer <= limit() || (longer <= kSlowest && longer <= 3 * shorter);
}

/// The stream goes on from two samples that follow each other.
StampVerdict StampJudge::begin(Stamp before, Stamp stamp, StampVerdict verdict) {
  last_ = std::max(before, stamp);
  period_ = std::max(from_to(before, stamp), Nanoseconds(0));
  held_ = 0;
  return verdict;
}

StampVerdict StampJudge::hold(Stamp stamp) {
  if (held_ == 0) held_first_ = stamp;
  held_last_ = stamp;
  ++held_;
  return StampVerdict::kHold;
}

StampVerdict StampJudge::judge_beginning(Stamp stamp) {
  if (held_ == 1 && is_near(held_first_, stamp))
    return begin(held_first_, stamp, StampVerdict::kConfirm);
  if (held_ < 2) return hold(stamp);
  if (agree(stamp)) return begin(held_last_, stamp, StampVerdict::kConfirm);
  if (is_near(held_last_, stamp)) return begin(held_last_, stamp, StampVerdict::kConfirmLast);
  if (is_near(held_first_, stamp)) return begin(held_first_, stamp, StampVerdict::kConfirmFirst);
  held_first_ = std::exchange(held_last_, stamp);
  return StampVerdict::kReplaceFirst;
}

void StampJudge::note_step() {
  const Nanoseconds step = from_to(*last_, held_first_);
  if (step < Nanoseconds(0)) {
    ++steps_.back;
    steps_.last_back = -step;
  } else if (step >= kSetAhead) {
    ++steps_.ahead;
    steps_.last_ahead = step;
  }
}

StampVerdict StampJudge::judge(Stamp stamp) {
  if (held_ > 0 && stamp == held_last_) return StampVerdict::kRefuse;
  if (!last_) return judge_beginning(stamp);
  if (goes_on(stamp)) {
    held_ = 0;
    if (stamp > *last_) {
      period_ += (from_to(*last_, stamp) - period_) / 8;
      last_ = stamp;
    }
    return StampVerdict::kGood;
  }
  if (held_ < 2) return hold(stamp);
  if (agree(stamp)) {
    note_step();
    return begin(held_last_, stamp, StampVerdict::kConfirm);
  }
  const bool follows_first = stamp > held_first_ && from_to(held_first_, stamp) <= limit();
  const bool follows_last = stamp > held_last_ && from_to(held_last_, stamp) <= limit();
  if (!follows_first || follows_last) held_first_ = held_last_;
  held_last_ = stamp;
  return follows_first && !follows_last ? StampVerdict::kReplaceLast : StampVerdict::kReplaceFirst;
}

void StampJudge::restart() {
  last_.reset();
  period_ = Nanoseconds(0);
  held_ = 0;
}

bool StampJudge::may_end() const {
  if (!last_) return true;
  const Nanoseconds first = from_to(*last_, held_first_);
  return first > Nanoseconds(0) && first <= kSilence;
}

}  // namespace swiftlet
