// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/joined_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/narrow.hpp"

namespace swiftlet {
namespace {

// 3 s: a D435 may stamp its first images by its own clock, until it knows the host's.
constexpr std::size_t kPatience = 90;
// What a stream may read ahead to find where its clock was set back, too: 10 s of a T265.
constexpr std::size_t kMostPosesAhead = 2000;
constexpr Nanoseconds kSilent = std::chrono::seconds(2);  // of one camera, while others see

}  // namespace

JoinedSource::JoinedSource(SourceInfo info, std::vector<DepthStreamPtr> cameras,
                           PoseStreamPtr poses, const Rig::Options& rig)
    : info_(std::move(info)), poses_(std::move(poses)), rig_(rig), gates_(cameras.size()) {
  SWIFTLET_REQUIRE(cameras.size() == rig.cameras.size(), "one stream a camera");
  for (DepthStreamPtr& stream : cameras) cameras_.push_back({std::move(stream)});
}

void JoinedSource::take_stock() {
  gates_.report_to(rig_);
  tally_ = rig_.tally();
  tally_.events = event_counts_;
}

std::vector<RigEvent> JoinedSource::take_events() {
  std::vector<RigEvent> events = events_.take();
  std::ranges::move(skipped_.take_events(), std::back_inserter(events));
  return events;
}

Expected<std::optional<Frame>> JoinedSource::next() {
  while (!has_ended_) {
    auto frame = rig_.pop();
    take_stock();
    if (frame) return frame;
    if (is_unwanted_ && is_unwanted_()) return std::nullopt;
    auto fits = check_clocks();
    if (fits && !is_played_) {
      auto has_more = advance();
      if (!has_more) fault_ = has_more.error();  // told when what came before has been delivered
      is_played_ = !has_more || !*has_more;
      if (is_played_) rig_.finish();
      continue;
    }
    has_ended_ = true;
    if (!fits) return forward_error(std::move(fits));
    if (fault_) return tl::make_unexpected(*fault_);
    return skipped_.end(rig_.tally());
  }
  return std::nullopt;
}

/// Looks one image ahead in one stream. A fault of it ends all, but what the gates hold.
void JoinedSource::fill(Camera& camera, std::size_t number) {
  StampGate<DepthFrame>& gate = gates_.cameras[number];
  while (!(camera.ahead = gate.pop()) && !camera.is_over) {
    Expected<std::optional<DepthFrame>> depth = std::nullopt;
    if (!fault_) depth = camera.stream->next();
    for (SkippedImage& image : camera.stream->take_skipped()) {
      rig_.lose(image.loss);
      skipped_.add(std::move(image.why));
    }
    if (!depth) fault_ = depth.error();
    camera.is_over = !depth || !*depth;
    if (camera.is_over) {
      gate.finish();
    } else {
      (*depth)->camera = to<std::uint8_t>(number);
      gate.push(std::move(**depth));
    }
  }
  camera.was_set_back = std::exchange(camera.clock, gate.steps().back) != gate.steps().back;
}

void JoinedSource::fill() {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    if (!cameras_[i].ahead) fill(cameras_[i], i);
  }
}

/// The camera whose image comes first: one whose clock has not been set back yet, where others'
/// have. Only so long: perhaps it never is.
JoinedSource::Camera* JoinedSource::earliest() {
  Camera* first = nullptr;
  const auto order = [](const Camera& camera) {
    return std::pair(camera.passed_over > kPatience ? 0 : camera.clock, camera.ahead->stamp);
  };
  for (Camera& camera : cameras_) {
    if (camera.ahead && (first == nullptr || order(camera) < order(*first))) first = &camera;
  }
  for (Camera& camera : cameras_) {
    if (first != nullptr && camera.ahead && camera.clock > first->clock) ++camera.passed_over;
  }
  return first;
}

Expected<bool> JoinedSource::advance() {
  fill();
  Camera* const first = earliest();
  if (first == nullptr && fault_) return tl::make_unexpected(*fault_);
  if (first == nullptr) return false;
  DepthFrame depth = *std::exchange(first->ahead, std::nullopt);
  const Stamp pose_time = depth.stamp + rig_.options().cameras[depth.camera].pose_offset;
  image_clock_ = depth.clock;
  if (std::exchange(first->was_set_back, false)) {
    if (auto followed = follow_set_clock(*first, depth.stamp); !followed)
      return forward_error(std::move(followed));
    rig_.restart_camera_clock(depth.camera, depth.stamp);
  }
  first->last = depth.stamp;
  watch_silence(depth.stamp);
  rig_.push(std::move(depth));
  if (auto pushed = push_poses_until(pose_time); !pushed) return forward_error(std::move(pushed));
  return true;
}

void JoinedSource::tell(RigEventKind kind, std::size_t camera, std::string what) {
  ++event_counts_[static_cast<std::size_t>(kind)];
  events_.add({kind, rig_.options().cameras[camera].title(), std::move(what)});
}

/// Notices a camera of several that has no images while the others have, as when it was unplugged.
void JoinedSource::watch_silence(Stamp now) {
  if (!start_) start_ = now;
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    Camera& camera = cameras_[i];
    const Stamp since = camera.last.value_or(*start_);
    const bool is_silent = now - since > kSilent;
    if (is_silent && !camera.is_silent) {
      tell(RigEventKind::kStalled, i,
           fmt::format("no image since {:.2f} s after the start; the others go on",
                       seconds(since - *start_)));
    } else if (!is_silent && camera.is_silent && now - since <= Nanoseconds(0)) {
      tell(RigEventKind::kRestarted, i, {});
      camera.is_silent = false;
    }
    camera.is_silent = camera.is_silent || is_silent;
  }
}

/// Reads on to the next pose that is to be believed, into pose_ahead_; false at the end.
Expected<bool> JoinedSource::look_at_pose() {
  std::optional<Error> fault;
  while (!pose_ahead_ && !(pose_ahead_ = gates_.poses.pop()) && poses_ != nullptr) {
    auto pose = poses_->next();
    for (Error& skipped : poses_->take_skipped()) skipped_.add(std::move(skipped));
    if (!pose) fault = pose.error();
    if (!pose || !*pose) {
      poses_ = nullptr;
      gates_.poses.finish();
    } else {
      gates_.poses.push(**pose);
    }
  }
  if (pose_ahead_ && gates_.poses.steps().back > poses_clock_) pose_was_set_back_ = true;
  if (fault) {
    while (pose_ahead_) {
      push_pose();
      pose_ahead_ = gates_.poses.pop();
    }
    return tl::make_unexpected(*fault);
  }
  return pose_ahead_.has_value();
}

void JoinedSource::push_pose() {
  if (std::exchange(pose_was_set_back_, false)) {
    poses_clock_ = gates_.poses.steps().back;
    rig_.restart_pose_clock(pose_ahead_->stamp);
  }
  waited_ = 0;
  rig_.push(*std::exchange(pose_ahead_, std::nullopt));
}

/// The clock of a camera was set back: reads on to where that of the poses was, if that is near.
Status JoinedSource::follow_set_clock(Camera& camera, Stamp first) {
  const bool is_followed = camera.matched < poses_clock_;
  for (std::size_t i = 0; !is_followed && i < kMostPosesAhead; ++i) {
    auto has_pose = look_at_pose();
    if (!has_pose) return forward_error(std::move(has_pose));
    if (!*has_pose) break;
    const bool is_it = pose_was_set_back_;
    if (!is_it && pose_ahead_->stamp < first - kSilent) break;  // it never was later
    push_pose();
    if (is_it) break;
  }
  camera.matched = poses_clock_;
  return Done{};
}

/// As a live rig would see it: every pose up to the first that is not before the image. Poses after
/// their clock was set back wait for the images after that, but not for ever.
Status JoinedSource::push_poses_until(Stamp stamp) {
  while (true) {
    auto has_pose = look_at_pose();
    if (!has_pose) return forward_error(std::move(has_pose));
    if (!*has_pose) return Done{};
    if (pose_was_set_back_) {
      if (++waited_ <= kPatience) return Done{};
      for (Camera& camera : cameras_) camera.matched = poses_clock_ + 1;  // theirs was not
    }
    const Stamp pushed = pose_ahead_->stamp;
    push_pose();
    if (pushed >= stamp) return Done{};
  }
}

Status JoinedSource::check_clocks() {
  const std::size_t mismatched = tally_.of(FrameLoss::kClockMismatch);
  const bool is_hopeless = mismatched >= kPatience || (is_played_ && mismatched > 0);
  if (!is_hopeless || tally_.delivered > 0) return Done{};
  return fail(ErrorCode::kCorruptInput, info_.uri,
              fmt::format("the depth images are stamped by {} and the poses by {}, so nobody can "
                          "tell which belong together",
                          name_of(image_clock_), name_of(rig_.pose_clock())),
              "record both cameras on one host with the option Global Time Enabled on");
}

}  // namespace swiftlet
