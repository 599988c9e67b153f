// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <random>

#include "swiftlet/base/time.hpp"
#include "swiftlet/sim/tracker/tracker_model.hpp"

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

/// The unreliable way of a tracker's samples.
class PoseDelivery {
 public:
  PoseDelivery(const PoseFaults& faults, std::uint64_t seed);

  /// A sample sets out, in time order.
  void send(const RawTrackerPose& pose);

  /// When the next of those sent arrives; nullopt if none is on its way.
  [[nodiscard]] std::optional<Stamp> next_arrival() const;
  /// REQUIRES: one is on its way.
  [[nodiscard]] RawTrackerPose take();
  /// Whether a sample of that time or later is never sent.
  [[nodiscard]] bool is_dead(Stamp stamp) const;

 private:
  struct Arrival {
    Stamp at;
    RawTrackerPose pose;
  };
  [[nodiscard]] Arrival arrival_of(const RawTrackerPose& pose) const;

  PoseFaults faults_;
  std::mt19937_64 random_;
  std::optional<Arrival> held_;  // until the sample that it swaps its stamp with is there
  std::deque<Arrival> on_the_way_;
};

}  // namespace swiftlet::sim
