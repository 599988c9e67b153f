// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/pose_faults.hpp"

#include <array>
#include <limits>
#include <utility>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/voxel_index.hpp"

// One line a fault: its name, what it sets, and what that is.
#define SWIFTLET_POSE_FAULTS(X)                                                          \
  X(nan, tracker.nan_chance = 0.03, "3 % of the poses are NaN")                          \
  X(jump, (tracker.jump = {seconds(at - Stamp{}), {0.4, -0.3, 0.0}, 0.0}),               \
    "the tracker recognises a place and moves by 0.5 m at once")                         \
  X(gap, (faults.silence = {at, std::chrono::milliseconds(300)}), "no poses for 300 ms") \
  X(delay, faults.arrives_late = std::chrono::milliseconds(40),                          \
    "poses arrive 40 ms late, rightly stamped")                                          \
  X(late_stamps, faults.stamped_late = std::chrono::milliseconds(40),                    \
    "poses are stamped 40 ms late by a clock that is behind")                            \
  X(swapped, faults.swap_chance = 0.05, "one pose in twenty has its neighbour's stamp")  \
  X(dead, (faults.silence = {at, Nanoseconds::max()}), "the tracker dies and says no more")

namespace swiftlet::sim {

std::span<const Registered<ApplyFault>> pose_faults() {
#define SWIFTLET_ROW(name, effect, summary)                                                      \
  Registered<ApplyFault>{#name, summary,                                                         \
                         []([[maybe_unused]] Stamp at, [[maybe_unused]] TrackerOptions& tracker, \
                            [[maybe_unused]] PoseFaults& faults) { effect; }},
  static constexpr std::array kFaults{SWIFTLET_POSE_FAULTS(SWIFTLET_ROW)};
#undef SWIFTLET_ROW
  return kFaults;
}

FaultyTracker::FaultyTracker(Tracker tracker, const PoseFaults& faults, std::uint64_t seed)
    : tracker_(std::move(tracker)), faults_(faults), random_(mix_bits(seed ^ 0xFA17)) {
  produce();
}

/// Fills the way until something is on it, or nothing ever will be.
void FaultyTracker::produce() {
  while (on_the_way_.empty()) {
    const bool is_dead = faults_.silence && faults_.silence->lasts == Nanoseconds::max() &&
                         tracker_.next_stamp() >= faults_.silence->from;
    if (is_dead) return;
    RawTrackerPose pose = tracker_.next();
    if (faults_.silence && pose.stamp >= faults_.silence->from &&
        pose.stamp - faults_.silence->from < faults_.silence->lasts)
      continue;
    on_the_way_.push_back({pose.stamp + faults_.arrives_late, pose});
    if (faults_.swap_chance > 0.0 &&
        std::uniform_real_distribution<double>()(random_) < faults_.swap_chance) {
      pose = tracker_.next();
      on_the_way_.push_back({pose.stamp + faults_.arrives_late, pose});
      std::swap(on_the_way_[0].pose.stamp, on_the_way_[1].pose.stamp);
    }
    for (Arrival& arrival : on_the_way_)
      arrival.pose.stamp = arrival.pose.stamp + faults_.stamped_late;
  }
}

std::optional<Stamp> FaultyTracker::next_arrival() const {
  if (on_the_way_.empty()) return std::nullopt;
  return on_the_way_.front().at;
}

RawTrackerPose FaultyTracker::next() {
  SWIFTLET_REQUIRE(!on_the_way_.empty(), "a dead tracker says nothing");
  RawTrackerPose pose = on_the_way_.front().pose;
  on_the_way_.pop_front();
  produce();
  return pose;
}

}  // namespace swiftlet::sim
