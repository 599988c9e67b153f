// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <span>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/sim/tracker/pose_delivery.hpp"
#include "swiftlet/sim/tracker/tracker.hpp"

namespace swiftlet::sim {

/// Faults that a user names, as in `sim:apartment?fault=jump`. Each sets what goes wrong, in the
/// tracker or behind it, at a time since the rig's start.
using ApplyFault = void (*)(Stamp at, TrackerOptions& tracker, PoseFaults& faults);
[[nodiscard]] std::span<const Registered<ApplyFault>> pose_faults();

/// A tracker and the unreliable way from it.
class FaultyTracker {
 public:
  FaultyTracker(Tracker tracker, const PoseFaults& faults, std::uint64_t seed);

  /// When the next sample arrives; nullopt if no other ever will.
  [[nodiscard]] std::optional<Stamp> next_arrival() const { return delivery_.next_arrival(); }
  /// REQUIRES: there is a next.
  [[nodiscard]] RawTrackerPose next();
  [[nodiscard]] const Tracker& tracker() const { return tracker_; }

 private:
  void produce();

  Tracker tracker_;
  PoseDelivery delivery_;
};

}  // namespace swiftlet::sim
