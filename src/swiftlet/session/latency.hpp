// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/pipeline/stage_times.hpp"

namespace swiftlet {

/// The smallest of the values that at least `share` of them do not exceed (nearest rank); 0 for
/// none. REQUIRES: 0 < share <= 1.
[[nodiscard]] Nanoseconds percentile(std::vector<Nanoseconds> values, double share);

/// Durations in classes that are at most 1/128 of their value wide, so that memory does not grow
/// with the flight. Real time: add() does not allocate.
class DurationCounts {
 public:
  DurationCounts();
  /// Negative durations, of clocks that were set, count as 0; those above 4.8 hours as that.
  void add(Nanoseconds duration);
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// As percentile() of all that were added, or above it by less than 0.8 %; never above the
  /// longest of them. REQUIRES: 0 < share <= 1.
  [[nodiscard]] Nanoseconds percentile(double share) const;

 private:
  static constexpr unsigned kFineBits = 7;   // 128 classes each time the duration doubles
  static constexpr unsigned kLongBits = 44;  // 2^44 ns are 4.8 hours
  static constexpr std::size_t kClasses = (kLongBits - kFineBits + 1) << kFineBits;
  struct Class {
    std::uint64_t count = 0;
    std::int64_t longest_ns = 0;
  };
  [[nodiscard]] static std::size_t class_of(std::uint64_t ns);

  std::vector<Class> classes_;
  std::uint64_t count_ = 0;
};

/// How long frames took, stage by stage; see DurationCounts for how exact it is.
class Latency {
 public:
  void add(const StageTimes& times);

  /// From the moment a frame was seen to the map that holds it; for frames that somebody waits for.
  void add_age(Nanoseconds age) { ages_.add(age); }

  [[nodiscard]] bool has_ages() const { return ages_.count() > 0; }
  [[nodiscard]] Nanoseconds age_percentile(double share) const { return ages_.percentile(share); }
  [[nodiscard]] std::size_t frame_count() const { return frames_.count(); }
  [[nodiscard]] Nanoseconds total() const { return total_; }  ///< of all frames and stages; exact
  [[nodiscard]] Nanoseconds frame_percentile(double share) const {
    return frames_.percentile(share);
  }
  [[nodiscard]] Nanoseconds stage_percentile(Stage stage, double share) const {
    return stages_[static_cast<std::size_t>(stage)].percentile(share);
  }

 private:
  DurationCounts frames_, ages_;
  std::array<DurationCounts, kStageNames.size()> stages_;
  Nanoseconds total_{0};
};

}  // namespace swiftlet
