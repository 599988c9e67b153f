// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/joined_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "swiftlet/base/contract.hpp"
#include "swiftlet/base/narrow.hpp"

namespace swiftlet {
namespace {

// 3 s: a D435 may stamp its first images by its own clock, until it knows the host's.
constexpr std::size_t kPatience = 90;

}  // namespace

JoinedSource::JoinedSource(SourceInfo info, std::vector<DepthStreamPtr> cameras,
                           PoseStreamPtr poses, const Rig::Options& rig)
    : info_(std::move(info)), poses_(std::move(poses)), rig_(rig) {
  SWIFTLET_REQUIRE(cameras.size() == rig.cameras.size(), "one stream a camera");
  for (DepthStreamPtr& stream : cameras) cameras_.push_back({std::move(stream), std::nullopt});
}

Expected<std::optional<Frame>> JoinedSource::next() {
  while (!has_ended_) {
    if (auto frame = rig_.pop()) return frame;
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

/// Looks one image ahead in every stream.
Status JoinedSource::fill() {
  for (std::size_t i = 0; i < cameras_.size(); ++i) {
    Camera& camera = cameras_[i];
    if (camera.ahead || camera.is_over) continue;
    auto depth = camera.stream->next();
    for (SkippedImage& image : camera.stream->take_skipped()) {
      rig_.lose(image.loss);
      skipped_.add(std::move(image.why));
    }
    if (!depth) return forward_error(std::move(depth));
    camera.is_over = !depth->has_value();
    camera.ahead = std::move(*depth);
    if (camera.ahead) camera.ahead->camera = to<std::uint8_t>(i);
  }
  return Done{};
}

Expected<bool> JoinedSource::advance() {
  if (auto filled = fill(); !filled) return forward_error(std::move(filled));
  Camera* first = nullptr;
  for (Camera& camera : cameras_) {
    if (camera.ahead && (first == nullptr || camera.ahead->stamp < first->ahead->stamp))
      first = &camera;
  }
  if (first == nullptr) return false;
  DepthFrame depth = *std::exchange(first->ahead, std::nullopt);
  const Stamp pose_time = depth.stamp + rig_.options().cameras[depth.camera].pose_offset;
  image_clock_ = depth.clock;
  rig_.push(std::move(depth));
  if (auto pushed = push_poses_until(pose_time); !pushed) return forward_error(std::move(pushed));
  return true;
}

/// As a live rig would see it: every pose up to the first that is not before the image.
Status JoinedSource::push_poses_until(Stamp stamp) {
  while (poses_ != nullptr) {
    auto pose = poses_->next();
    if (!pose) return forward_error(std::move(pose));
    if (!*pose) {
      poses_ = nullptr;
      return Done{};
    }
    rig_.push(**pose);
    if ((*pose)->stamp >= stamp) return Done{};
  }
  return Done{};
}

Status JoinedSource::check_clocks() {
  FrameTally tally = rig_.tally();
  const std::size_t mismatched = tally.of(FrameLoss::kClockMismatch);
  const bool is_hopeless = mismatched >= kPatience || (is_played_ && mismatched > 0);
  if (!is_hopeless || tally.delivered > 0) return Done{};
  return fail(ErrorCode::kCorruptInput, info_.uri,
              fmt::format("the depth images are stamped by {} and the poses by {}, so nobody can "
                          "tell which belong together",
                          name_of(image_clock_), name_of(rig_.pose_clock())),
              "record both cameras on one host with the option Global Time Enabled on");
}

}  // namespace swiftlet
