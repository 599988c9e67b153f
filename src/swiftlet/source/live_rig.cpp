// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/live_rig.hpp"

#include <fmt/format.h>

#include <utility>

#include "swiftlet/base/contract.hpp"

namespace swiftlet {

LiveRig::LiveRig(SourceInfo info, const Options& options)
    : info_(std::move(info)), options_(options), rig_(options.rig) {
  SWIFTLET_REQUIRE(options.queue.capacity >= 1, "a queue holds a frame");
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

void LiveRig::push(const PoseSample& pose) {
  const std::lock_guard lock(mutex_);
  rig_.push(pose);
  collect();
}

void LiveRig::push(DepthFrame depth) {
  const std::lock_guard lock(mutex_);
  ++images_;
  if (!depth.seen_at) depth.seen_at = std::chrono::steady_clock::now();
  rig_.push(std::move(depth));
  collect();
  changed_.notify_all();  // the camera lives, even if its image has no pose yet
}

void LiveRig::start_poses_anew() {
  const std::lock_guard lock(mutex_);
  rig_.start_poses_anew();
}

void LiveRig::close() {
  const std::lock_guard lock(mutex_);
  is_closed_ = true;
  rig_.finish();
  collect();
  changed_.notify_all();
}

Expected<std::optional<Frame>> LiveRig::next() {
  std::unique_lock lock(mutex_);
  bool is_alive = true;
  while (queue_.empty() && !is_closed_ && is_alive) {
    const std::size_t seen = images_;
    is_alive = changed_.wait_for(lock, options_.patience,
                                 [&] { return !queue_.empty() || is_closed_ || images_ != seen; });
  }
  std::optional<Frame> frame;
  if (!queue_.empty()) {
    frame = std::move(queue_.front());
    queue_.pop_front();
    ++delivered_;
  }
  tally_ = rig_.tally();
  tally_.of(FrameLoss::kOverload) += overloaded_;
  tally_.delivered = delivered_;
  if (frame || is_alive) return frame;
  return fail(ErrorCode::kIo, info_.uri,
              fmt::format("no image has come for {:.1f} s", seconds(options_.patience)),
              "check the cable and that the camera is on a USB 3 port of its own");
}

}  // namespace swiftlet
