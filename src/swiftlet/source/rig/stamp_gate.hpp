// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/source/rig/stamp_judge.hpp"

namespace swiftlet {

/// A stream of samples behind a StampJudge: samples go in as they come, and those whose time is to
/// be believed come out in the same order. `Sample` has a `stamp` and a `clock`; a sample of
/// another clock begins the stream again.
/// Memory: StampJudge::kConfirm samples. Allocates nothing. Thread safety: none, one owner.
template <class Sample>
class StampGate {
 public:
  /// REQUIRES: pop() has given all it has.
  void push(Sample sample) {
    SWIFTLET_REQUIRE(next_ == ready_, "what came out of the gate was taken");
    next_ = ready_ = 0;
    if (clock_ && *clock_ != sample.clock) {
      release();
      judge_.restart();
    }
    clock_ = sample.clock;
    const StampVerdict verdict = judge_.judge(sample.stamp);
    switch (verdict) {
      case StampVerdict::kGood:
        drop();
        return add_ready(std::move(sample));
      case StampVerdict::kConfirmFirst:
      case StampVerdict::kConfirmLast:
        drop_one(verdict == StampVerdict::kConfirmLast);
        [[fallthrough]];
      case StampVerdict::kConfirm:
        release();
        return add_ready(std::move(sample));
      case StampVerdict::kReplaceFirst:
      case StampVerdict::kReplaceLast:
        drop_one(verdict == StampVerdict::kReplaceFirst);
        [[fallthrough]];
      case StampVerdict::kHold:
        held_[held_count_++] = std::move(sample);
        return;
      case StampVerdict::kRefuse:
        ++refused_;
    }
  }

  /// The next sample that is to be believed; nullopt until more has come.
  [[nodiscard]] std::optional<Sample> pop() {
    if (next_ == ready_) return std::nullopt;
    return std::exchange(out_[next_++], std::nullopt);
  }

  /// Nothing more will come: what is held is decided now.
  void finish() {
    if (next_ == ready_) next_ = ready_ = 0;
    judge_.may_end() ? release() : drop();
  }

  /// Samples whose stamp was wrong.
  [[nodiscard]] std::size_t refused() const { return refused_; }
  [[nodiscard]] const ClockSteps& steps() const { return judge_.steps(); }

 private:
  /// Of the two that are held.
  void drop_one(bool is_first) {
    if (is_first) held_[0] = std::move(held_[1]);
    held_[1].reset();
    held_count_ = 1;
    ++refused_;
  }
  void add_ready(Sample&& sample) { out_[ready_++] = std::move(sample); }
  void release() {
    for (std::size_t i = 0; i < held_count_; ++i)
      add_ready(std::move(*std::exchange(held_[i], std::nullopt)));
    held_count_ = 0;
  }
  void drop() {
    refused_ += held_count_;
    for (std::size_t i = 0; i < held_count_; ++i) held_[i].reset();
    held_count_ = 0;
  }

  StampJudge judge_;
  std::array<std::optional<Sample>, StampJudge::kConfirm - 1> held_;
  std::array<std::optional<Sample>, 2 * StampJudge::kConfirm> out_;
  std::size_t held_count_ = 0, next_ = 0, ready_ = 0;
  std::optional<ClockDomain> clock_;
  std::size_t refused_ = 0;
};

}  // namespace swiftlet
