// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/tracker/pose_faults.hpp"

#include <array>
#include <limits>
#include <utility>

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
    : tracker_(std::move(tracker)), delivery_(faults, seed) {
  produce();
}

/// Sends samples until one is on its way, or none ever will be.
void FaultyTracker::produce() {
  while (!delivery_.next_arrival() && !delivery_.is_dead(tracker_.next_stamp()))
    delivery_.send(tracker_.next());
}

RawTrackerPose FaultyTracker::next() {
  const RawTrackerPose pose = delivery_.take();
  produce();
  return pose;
}

}  // namespace swiftlet::sim
