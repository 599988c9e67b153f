// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "swiftlet/base/time.hpp"

namespace swiftlet {

/// What is to be done with a sample by its stamp.
enum class StampVerdict : std::uint8_t {
  kGood,          ///< it goes on; what is held was wrong
  kHold,          ///< it is held: the next ones decide
  kConfirm,       ///< it and all that is held go on: the stream has begun, or its time has stepped
  kConfirmFirst,  ///< likewise, but the second of the two that are held was wrong
  kConfirmLast,   ///< likewise, but the first of the two that are held was wrong
  kReplaceFirst,  ///< it is held, and the first of the two that are held was wrong
  kReplaceLast,   ///< it is held, and the second of the two that are held was wrong
  kRefuse,        ///< it is wrong
};

/// Steps of a stream's time that were believed.
struct ClockSteps {
  std::size_t back = 0;       ///< times it was set back
  std::size_t ahead = 0;      ///< times it went ahead by an hour or more
  Nanoseconds last_back{0};   ///< how far, the last time; not negative
  Nanoseconds last_ahead{0};  ///< likewise
};

/// Judges the stamps of one stream by more than the one before: a stamp that goes back by more than
/// 0.25 s, or ahead by more than a second and 20 of the stream's periods, is held; it is believed
/// when three in a row agree, and was wrong when the next one goes on as before (docs/rig.md).
///
/// Three in a row agree if each is later than the one before, but by no more than a stream goes on,
/// or if they come evenly, as of a slow stream. At the beginning two of the first three are enough
/// that are no more than a second apart. So one wrong stamp costs one sample, and a clock that is
/// set costs none. Nothing is allocated.
class StampJudge {
 public:
  static constexpr std::size_t kConfirm = 3;

  [[nodiscard]] StampVerdict judge(Stamp stamp);
  /// The stream begins again, as with another clock.
  void restart();
  /// Whether what is held at the end of the stream may go on: at its beginning, or after a silence.
  [[nodiscard]] bool may_end() const;

  [[nodiscard]] const ClockSteps& steps() const { return steps_; }

 private:
  [[nodiscard]] Nanoseconds limit() const;
  [[nodiscard]] bool goes_on(Stamp stamp) const;
  [[nodiscard]] bool agree(Stamp third) const;
  [[nodiscard]] StampVerdict judge_beginning(Stamp stamp);
  [[nodiscard]] StampVerdict hold(Stamp stamp);
  [[nodiscard]] StampVerdict begin(Stamp before, Stamp stamp, StampVerdict verdict);
  void note_step();

  std::optional<Stamp> last_;  // the latest that was good
  Nanoseconds period_{0};      // 0: not known yet
  std::size_t held_ = 0;
  Stamp held_first_, held_last_;
  ClockSteps steps_;
};

}  // namespace swiftlet
