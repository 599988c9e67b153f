// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/rig.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {
namespace {

// Between the last frame before a clock was set back and the first after, for nobody knows better.
constexpr Nanoseconds kSetClockTakes = std::chrono::milliseconds(100);

}  // namespace

Rig::Rig(const Options& options)
    : options_(options),
      poses_(options.poses),
      last_stamp_(options.cameras.size()),
      masks_(options.cameras.size()) {
  SWIFTLET_REQUIRE(!options.cameras.empty() && options.cameras.size() <= kMaxCameras,
                   "a rig has 1 to 8 cameras");
  facts_.cameras.resize(options.cameras.size());
}

void Rig::push(const PoseSample& pose) {
  facts_.poses.note(pose);
  poses_.push(pose);
  count_refused_poses();
  tally_.pose_jumps = poses_.jumps();
  watch_staleness();
}

void Rig::count_refused_poses() {
  tally_.poses_refused_by = poses_.refused();
  tally_.poses_refused =
      std::accumulate(poses_.refused().begin(), poses_.refused().end(), std::size_t{0});
}

void Rig::note_stamps(const StampTally& stamps) {
  tally_.of(FrameLoss::kBadStamp) = stamps.images_refused;
  tally_.pose_clock = stamps.pose_clock;
  tally_.image_clock = stamps.image_clock;
  poses_.note_bad_stamps(stamps.poses_refused);
  count_refused_poses();
}

template <class IsOld>
void Rig::lose_waiting(IsOld is_old) {
  tally_.of(FrameLoss::kNoPose) += std::erase_if(waiting_, is_old);
  newest_depth_.reset();
  resumed_at_.reset();
  for (const DepthFrame& depth : waiting_)
    newest_depth_ = newest_depth_ ? std::max(*newest_depth_, depth.stamp) : depth.stamp;
}

void Rig::restart_pose_clock(Stamp first) {
  poses_.restart_clock(first);
  lose_waiting([](const DepthFrame&) { return true; });
  std::ranges::fill(last_stamp_, std::nullopt);
  last_decided_.reset();
  last_delivered_.reset();
  is_out_offset_known_ = false;
}

void Rig::restart_camera_clock(std::size_t camera, Stamp first) {
  lose_waiting(
      [&](const DepthFrame& depth) { return depth.camera == camera && depth.stamp >= first; });
  last_stamp_[camera].reset();
  last_decided_ = last_delivered_;
}

void Rig::push(DepthFrame depth) {
  SWIFTLET_REQUIRE(depth.camera < options_.cameras.size(), "the rig has no such camera");
  facts_.cameras[depth.camera].note(depth);
  std::optional<Stamp>& last = last_stamp_[depth.camera];
  const bool is_late = last_decided_ && order_of(depth) <= *last_decided_;
  if ((last && depth.stamp <= *last) || is_late) {
    ++tally_.of(FrameLoss::kOutOfOrder);
    return;
  }
  last = depth.stamp;
  note_step_to(depth.stamp);
  newest_depth_ = newest_depth_ ? std::max(*newest_depth_, depth.stamp) : depth.stamp;
  watch_staleness();
  if (waiting_.size() == options_.max_waiting * options_.cameras.size()) {
    ++tally_.of(is_stale_ ? FrameLoss::kPoseStale : FrameLoss::kNoPose);
    last_decided_ = order_of(waiting_.front());
    waiting_.pop_front();
  }
  const auto place = std::ranges::upper_bound(waiting_, order_of(depth), {}, order_of);
  waiting_.insert(place, std::move(depth));
}

/// Notices images whose time has stepped ahead: that the poses' has not yet says nothing of them.
/// Once only until they have followed, or a silent tracker would be noticed by no slow camera.
void Rig::note_step_to(Stamp stamp) {
  if (!newest_depth_ || stamp - *newest_depth_ <= options_.stale_after) return;
  const auto newest = poses_.newest();
  if (!resumed_at_ || (newest && *newest >= *resumed_at_)) resumed_at_ = stamp;
}

/// Counts each time the tracker falls silent, and notices when it is back.
void Rig::watch_staleness() {
  if (!newest_depth_ || !poses_.newest()) return;
  const Stamp since = std::max(*poses_.newest(), resumed_at_.value_or(*poses_.newest()));
  const bool is_stale = *newest_depth_ - since > options_.stale_after;
  if (is_stale && !is_stale_) ++tally_.stale_alarms;
  is_stale_ = is_stale;
}

Stamp Rig::pose_time(const DepthFrame& depth) const {
  return depth.stamp + options_.cameras[depth.camera].pose_offset;
}

/// Whether no image of that time or before can still arrive.
bool Rig::is_settled(Stamp stamp) const {
  if (is_finished_ || *newest_depth_ - stamp >= options_.reorder_window) return true;
  return std::ranges::all_of(last_stamp_, [&](const auto& last) { return last && *last >= stamp; });
}

/// Why an image has no pose; nullopt while it may still get one.
std::optional<FrameLoss> Rig::loss_of(const DepthFrame& depth, PoseMiss miss) const {
  switch (miss) {
    case PoseMiss::kGapTooLong:
      return FrameLoss::kPoseGap;
    case PoseMiss::kAcrossJump:
      return FrameLoss::kPoseJump;
    case PoseMiss::kBeforeFirst:
      return FrameLoss::kNoPose;
    case PoseMiss::kEmpty:
    case PoseMiss::kAfterLast:
      break;
  }
  if (!is_finished_) return std::nullopt;
  const auto newest = poses_.newest();
  const bool is_silent = newest && pose_time(depth) - *newest > options_.stale_after;
  return is_silent ? FrameLoss::kPoseStale : FrameLoss::kNoPose;
}

Frame Rig::posed(DepthFrame depth, const TrackedPose& pose) {
  const RigCamera& camera = options_.cameras[depth.camera];
  if (options_.body_box) {
    std::optional<BodyBoxMask>& mask = masks_[depth.camera];
    if (!mask || !(mask->intrinsics() == depth.intrinsics))
      mask.emplace(*options_.body_box, camera.T_body_camera, depth.intrinsics);
    mask->clear(depth.depth);
  }
  if (!std::exchange(is_out_offset_known_, true) && last_out_)
    out_offset_ = *last_out_ + kSetClockTakes - depth.stamp;
  last_out_ = depth.stamp + out_offset_;
  return Frame{*last_out_,        std::move(depth.depth),
               depth.intrinsics,  pose.T_world_body * camera.T_body_camera,
               depth.camera,      pose.mark.epoch,
               camera.baseline_m, depth.seen_at};
}

std::optional<Frame> Rig::pop() {
  while (!waiting_.empty() && is_settled(waiting_.front().stamp)) {
    const DepthFrame& front = waiting_.front();
    const Stamp time = pose_time(front);
    const auto pose = options_.pairing == PosePairing::kInterpolate ? poses_.track().find(time)
                                                                    : poses_.track().nearest(time);
    std::optional<FrameLoss> loss;
    if (!is_same_clock(front.clock, poses_.clock())) {
      loss = FrameLoss::kClockMismatch;
    } else if (!pose) {
      loss = loss_of(front, pose.error());
      if (!loss) return std::nullopt;
    }
    DepthFrame depth = std::move(waiting_.front());
    waiting_.pop_front();
    last_decided_ = order_of(depth);
    if (loss) {
      ++tally_.of(*loss);
      continue;
    }
    ++tally_.delivered;
    last_delivered_ = last_decided_;
    return posed(std::move(depth), *pose);
  }
  return std::nullopt;
}

}  // namespace swiftlet
