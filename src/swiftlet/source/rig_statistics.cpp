// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig_statistics.hpp"

#include <cmath>

#include "swiftlet/base/frame_of.hpp"

namespace swiftlet {

void StreamStatistics::note(Stamp stamp, ClockDomain clock) {
  ++samples;
  ++clocks[static_cast<std::size_t>(clock)];
  if (previous_ && stamp <= *previous_) ++backward;
  constexpr Nanoseconds kSetAhead = std::chrono::hours(1);  // no silence is that long
  if (previous_ && stamp > *previous_ && stamp - *previous_ < kSetAhead) {
    longest_gap = std::max(longest_gap, stamp - *previous_);
    passed_ += stamp - *previous_;
  }
  previous_ = stamp;
  first = first ? std::min(*first, stamp) : stamp;
  last = last ? std::max(*last, stamp) : stamp;
}

double StreamStatistics::rate_hz() const {
  const double duration_s = seconds(passed_);
  return samples > 1 && duration_s > 0.0 ? static_cast<double>(samples - 1) / duration_s : 0.0;
}

void CameraStatistics::note(const DepthFrame& depth) {
  StreamStatistics::note(depth.stamp, depth.clock);
  if (intrinsics && !(*intrinsics == depth.intrinsics)) {
    ++intrinsics_changes;
    if (!intrinsics_changed) intrinsics_changed = depth.stamp;
  }
  intrinsics = depth.intrinsics;
  unit_m = depth.depth.unit_m;
}

void PoseFacts::note(const PoseSample& pose) {
  StreamStatistics::note(pose.stamp, pose.clock);
  ++confidence[std::min<std::size_t>(pose.confidence, confidence.size() - 1)];
  const auto T = Transform<World, Body>::from(pose.R_world_body, pose.t_world_body_m);
  if (!T) {
    ++broken;
    return;
  }
  const bool is_first = !least_tilt_rad;
  low_m = is_first ? T->translation() : low_m.cwiseMin(T->translation());
  high_m = is_first ? T->translation() : high_m.cwiseMax(T->translation());
  const double up = (T->rotation() * Eigen::Vector3d::UnitZ()).z();
  const double tilt_rad = std::acos(std::clamp(up, -1.0, 1.0));
  least_tilt_rad = is_first ? tilt_rad : std::min(*least_tilt_rad, tilt_rad);
}

}  // namespace swiftlet
