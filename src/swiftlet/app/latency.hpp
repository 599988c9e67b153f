// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <vector>

#include "swiftlet/pipeline/stage_times.hpp"

namespace swiftlet::app {

/// The smallest of the values that at least `share` of them do not exceed (nearest rank); 0 for
/// none. REQUIRES: 0 < share <= 1.
[[nodiscard]] Nanoseconds percentile(std::vector<Nanoseconds> values, double share);

/// How long frames took, stage by stage.
class Latency {
 public:
  void add(const StageTimes& times) { frames_.push_back(times); }

  /// From the moment a frame was seen to the map that holds it; for frames that somebody waits for.
  void add_age(Nanoseconds age) { ages_.push_back(age); }

  [[nodiscard]] bool has_ages() const { return !ages_.empty(); }
  [[nodiscard]] Nanoseconds age_percentile(double share) const { return percentile(ages_, share); }
  [[nodiscard]] std::size_t frame_count() const { return frames_.size(); }
  [[nodiscard]] Nanoseconds total() const;  ///< of all frames and stages
  [[nodiscard]] Nanoseconds frame_percentile(double share) const;
  [[nodiscard]] Nanoseconds stage_percentile(Stage stage, double share) const;

 private:
  std::vector<StageTimes> frames_;
  std::vector<Nanoseconds> ages_;
};

}  // namespace swiftlet::app
