// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig.hpp"

#include <utility>

namespace swiftlet {
namespace {

FrameLoss loss_for(PoseMiss miss) {
  return miss == PoseMiss::kGapTooLong ? FrameLoss::kPoseGap : FrameLoss::kNoPose;
}

}  // namespace

Rig::Rig(const Options& options) : options_(options), track_(options.track) {}

void Rig::push(const PoseSample& pose) {
  const bool is_trusted = pose.confidence >= options_.min_confidence;
  const bool is_usable = is_trusted && track_.push(pose.stamp, pose.R_world_body,
                                                   pose.t_world_body_m) == PoseIntake::kAdded;
  if (!is_usable) ++tally_.poses_refused;
}

void Rig::push(DepthFrame depth) {
  if (last_depth_stamp_ && depth.stamp <= *last_depth_stamp_) {
    ++tally_.of(FrameLoss::kOutOfOrder);
    return;
  }
  last_depth_stamp_ = depth.stamp;
  if (waiting_.size() == options_.max_waiting) {
    ++tally_.of(FrameLoss::kNoPose);
    waiting_.pop_front();
  }
  waiting_.push_back(std::move(depth));
}

std::optional<Frame> Rig::pop() {
  while (!waiting_.empty()) {
    const auto T_world_body = track_.at(waiting_.front().stamp);
    const bool may_still_come =
        !T_world_body && !is_finished_ &&
        (T_world_body.error() == PoseMiss::kEmpty || T_world_body.error() == PoseMiss::kAfterLast);
    if (may_still_come) return std::nullopt;

    DepthFrame depth = std::move(waiting_.front());
    waiting_.pop_front();
    if (!T_world_body) {
      ++tally_.of(loss_for(T_world_body.error()));
      continue;
    }
    ++tally_.delivered;
    return Frame{depth.stamp, std::move(depth.depth), depth.intrinsics,
                 *T_world_body * options_.T_body_camera};
  }
  return std::nullopt;
}

}  // namespace swiftlet
