// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/tracker/pose_delivery.hpp"

#include <utility>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/voxel_index.hpp"

namespace swiftlet::sim {

PoseDelivery::PoseDelivery(const PoseFaults& faults, std::uint64_t seed)
    : faults_(faults), random_(mix_bits(seed ^ 0xFA17)) {}

PoseDelivery::Arrival PoseDelivery::arrival_of(const RawTrackerPose& pose) const {
  Arrival arrival{pose.stamp + faults_.arrives_late, pose};
  arrival.pose.stamp = pose.stamp + faults_.stamped_late;
  return arrival;
}

bool PoseDelivery::is_dead(Stamp stamp) const {
  return faults_.silence && faults_.silence->lasts == Nanoseconds::max() &&
         stamp >= faults_.silence->from;
}

void PoseDelivery::send(const RawTrackerPose& pose) {
  if (held_) {
    Arrival second = arrival_of(pose);
    std::swap(held_->pose.stamp, second.pose.stamp);
    on_the_way_.push_back(*std::exchange(held_, std::nullopt));
    on_the_way_.push_back(second);
    return;
  }
  if (faults_.silence && pose.stamp >= faults_.silence->from &&
      pose.stamp - faults_.silence->from < faults_.silence->lasts)
    return;
  const bool swaps = faults_.swap_chance > 0.0 &&
                     std::uniform_real_distribution<double>()(random_) < faults_.swap_chance;
  if (swaps) {
    held_ = arrival_of(pose);
  } else {
    on_the_way_.push_back(arrival_of(pose));
  }
}

std::optional<Stamp> PoseDelivery::next_arrival() const {
  if (on_the_way_.empty()) return std::nullopt;
  return on_the_way_.front().at;
}

RawTrackerPose PoseDelivery::take() {
  SWIFTLET_REQUIRE(!on_the_way_.empty(), "a dead tracker says nothing");
  const RawTrackerPose pose = on_the_way_.front().pose;
  on_the_way_.pop_front();
  return pose;
}

}  // namespace swiftlet::sim
