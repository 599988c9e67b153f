// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/live/live_rig.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {
namespace {

constexpr Nanoseconds kPollPeriod = std::chrono::milliseconds(100);  // at whether to go on waiting

}  // namespace

LiveRig::LiveRig(SourceInfo info, const Options& options)
    : info_(std::move(info)),
      options_(options),
      rig_(options.rig),
      gates_(options.rig.cameras.size()),
      image_clocks_(options.rig.cameras.size()),
      last_images_(options.rig.cameras.size()) {
  SWIFTLET_REQUIRE(options.queue.capacity >= 1, "a queue holds a frame");
  facts_ = rig_.statistics();
}

void LiveRig::collect() {
  while (auto frame = rig_.pop()) {
    if (queue_.size() == options_.queue.capacity) {
      queue_.pop_front();
      ++overloaded_;
    }
    queue_.push_back(std::move(*frame));
    changed_.notify_all();
  }
}

void LiveRig::push_believed_poses() {
  while (const auto pose = gates_.poses.pop()) {
    const std::size_t clocks = gates_.poses.steps().back;
    if (std::exchange(pose_clocks_, clocks) != clocks) rig_.restart_pose_clock(pose->stamp);
    rig_.push(*pose);
  }
  collect();
}

void LiveRig::push_believed_images(std::size_t camera) {
  StampGate<DepthFrame>& gate = gates_.cameras[camera];
  while (auto depth = gate.pop()) {
    const std::size_t clocks = gate.steps().back;
    if (std::exchange(image_clocks_[camera], clocks) != clocks)
      rig_.restart_camera_clock(camera, depth->stamp);
    rig_.push(std::move(*depth));
  }
  collect();
}

void LiveRig::push(const PoseSample& pose) {
  const std::lock_guard lock(mutex_);
  last_pose_ = HostTime::clock::now();
  gates_.poses.push(pose);
  push_believed_poses();
}

void LiveRig::push(DepthFrame depth) {
  SWIFTLET_REQUIRE(depth.camera < last_images_.size(), "the rig has no such camera");
  const std::lock_guard lock(mutex_);
  ++images_;
  const HostTime now = HostTime::clock::now();
  last_images_[depth.camera] = now;
  if (!depth.seen_at) depth.seen_at = now;
  const std::size_t camera = depth.camera;
  gates_.cameras[camera].push(std::move(depth));
  push_believed_images(camera);
}

void LiveRig::note(RigEvent event) {
  const std::lock_guard lock(mutex_);
  event_counts_[static_cast<std::size_t>(event.kind)] += event.count;
  events_.add(std::move(event));
}

std::vector<RigEvent> LiveRig::take_events() {
  const std::lock_guard lock(mutex_);
  return events_.take();
}

std::optional<HostTime> LiveRig::last_image(std::size_t camera) const {
  SWIFTLET_REQUIRE(camera < last_images_.size(), "the rig has no such camera");
  const std::lock_guard lock(mutex_);
  return last_images_[camera];
}

std::optional<HostTime> LiveRig::last_pose() const {
  const std::lock_guard lock(mutex_);
  return last_pose_;
}

void LiveRig::start_poses_anew() {
  const std::lock_guard lock(mutex_);
  rig_.start_poses_anew();
}

void LiveRig::close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  gates_.poses.finish();
  push_believed_poses();
  for (std::size_t i = 0; i < gates_.cameras.size(); ++i) {
    gates_.cameras[i].finish();
    push_believed_images(i);
  }
  rig_.finish();
  collect();
  changed_.notify_all();
}

void LiveRig::take_stock() {
  gates_.report_to(rig_);
  tally_ = rig_.tally();
  tally_.of(FrameLoss::kOverload) += overloaded_;
  tally_.delivered = delivered_;
  tally_.events = event_counts_;
  facts_ = rig_.statistics();
}

Expected<std::optional<Frame>> LiveRig::next() {
  std::unique_lock lock(mutex_);
  bool is_unwanted = false;
  std::size_t seen = images_;
  HostTime alive_at = HostTime::clock::now();
  const auto is_silent = [&] { return HostTime::clock::now() - alive_at > options_.timeout; };
  while (queue_.empty() && !is_closed_ && !is_unwanted && !is_silent()) {
    changed_.wait_for(lock, std::min(kPollPeriod, options_.timeout),
                      [this] { return !queue_.empty() || is_closed_; });
    if (images_ != seen) alive_at = HostTime::clock::now();
    seen = images_;
    take_stock();
    lock.unlock();  // it is somebody else's function
    is_unwanted = is_unwanted_ && is_unwanted_();
    lock.lock();
  }
  std::optional<Frame> frame;
  if (!queue_.empty()) {
    frame = std::move(queue_.front());
    queue_.pop_front();
    ++delivered_;
  }
  take_stock();
  if (frame || is_closed_ || is_unwanted) return frame;
  return fail(ErrorCode::kIo, info_.uri,
              fmt::format("no image has come for {:.1f} s", seconds(options_.timeout)),
              "check the cable and that the camera is on a USB 3 port of its own");
}

}  // namespace swiftlet
