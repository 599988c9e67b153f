// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <deque>
#include <optional>
#include <random>
#include <span>
#include <string_view>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/sim/tracker.hpp"

namespace swiftlet::sim {

/// What goes wrong between a tracker and whoever uses its poses. Times are since its start.
struct PoseFaults {
  struct Silence {
    Stamp from;
    Nanoseconds lasts;
  };
  std::optional<Silence> silence;  ///< samples that never come
  Nanoseconds arrives_late{0};     ///< on the way; the stamps are right
  Nanoseconds stamped_late{0};     ///< by a clock that is behind
  double swap_chance = 0.0;        ///< of two neighbours to get each other's stamp
};

/// Faults that a user names, as in `sim:apartment?fault=jump`. Each sets what goes wrong, in the
/// tracker or behind it, at a time since the rig's start.
using ApplyFault = void (*)(Stamp at, TrackerOptions& tracker, PoseFaults& faults);
[[nodiscard]] std::span<const Registered<ApplyFault>> pose_faults();

/// A tracker and the unreliable way from it.
class FaultyTracker {
 public:
  struct Arrival {
    Stamp at;
    RawTrackerPose pose;
  };
  FaultyTracker(Tracker tracker, const PoseFaults& faults, std::uint64_t seed);

  /// When the next sample arrives; nullopt if no other ever will.
  [[nodiscard]] std::optional<Stamp> next_arrival() const;
  /// REQUIRES: there is a next.
  [[nodiscard]] RawTrackerPose next();
  [[nodiscard]] const Tracker& tracker() const { return tracker_; }

 private:
  void produce();

  Tracker tracker_;
  PoseFaults faults_;
  std::mt19937_64 random_;
  std::deque<Arrival> on_the_way_;
};

}  // namespace swiftlet::sim
