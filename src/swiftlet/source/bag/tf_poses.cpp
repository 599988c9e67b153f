// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/frame/pose_track.hpp"
#include "swiftlet/source/bag/bag_scan.hpp"
#include "swiftlet/source/bag/tf_chain.hpp"

// The poses of recordings of ROS that tell them by tf. There is one for every stamp of the lowest
// tie that moves (odom to base_link, say); the ties above it (map to odom) are interpolated at that
// time, as tf2 does. A tie that has fallen silent stays as it was last.

namespace swiftlet {
namespace {

using Tie = Transform<World, Body>;  // of the child in the parent, whatever the two are

constexpr Nanoseconds kPatience = std::chrono::seconds(1);  // how long one tie waits for another
constexpr std::size_t kMostWaiting = 4096;

/// One tie of the chain over time.
class TfTrack {
 public:
  explicit TfTrack(TfChain::Tie names) : names_(std::move(names)) {
    if (const auto T = Tie::from(names_.first.R, names_.first.t_m)) fixed_ = *T;
  }

  [[nodiscard]] bool is_of(const ros::StampedPose& pose) const {
    return !names_.is_static && is_same_name(pose.child, names_.child) &&
           is_same_name(pose.parent, names_.parent);
  }
  [[nodiscard]] bool moves() const { return !names_.is_static; }

  PoseIntake push(const ros::StampedPose& pose) {
    const PoseIntake intake = track_.push(pose.stamp, pose.pose.R, pose.pose.t_m);
    if (intake == PoseIntake::kAdded) newest_ = std::max(newest_.value_or(pose.stamp), pose.stamp);
    return intake;
  }

  /// nullopt if it is not known (yet). `is_late`: nothing newer is waited for.
  [[nodiscard]] std::optional<Tie> at(Stamp stamp, bool is_late) const {
    if (names_.is_static) return fixed_;
    const bool is_over = is_late && newest_ && stamp > *newest_;
    const auto T = track_.at(is_over ? *newest_ : stamp);
    return T ? std::optional(*T) : std::nullopt;
  }

  [[nodiscard]] const std::optional<Stamp>& newest() const { return newest_; }

  void clear() {
    track_.clear();
    newest_.reset();
  }

 private:
  TfChain::Tie names_;
  std::optional<Tie> fixed_;  // a static one's; nullopt if it was no rigid transform
  PoseTrack track_{{.capacity = kMostWaiting, .max_gap = Nanoseconds::max()}};
  std::optional<Stamp> newest_;
};

class TfPoses final : public PoseStream {
 public:
  TfPoses(RecordingReaderPtr reader, BagTopics topics, const TfChain& chain)
      : reader_(std::move(reader)), topics_(std::move(topics)) {
    for (const TfChain::Tie& tie : chain.ties) tracks_.emplace_back(tie);
  }

  Expected<std::optional<PoseSample>> next() override {
    while (ready_.empty()) {
      auto message = read_after(*reader_, fault_, !waiting_.empty());
      if (!message) return forward_error(std::move(message));
      if (!*message) {
        settle(true);
        if (ready_.empty()) return std::nullopt;
        break;
      }
      const BagConnection& connection = *(*message)->connection;
      if (!is_wanted_tf(connection, topics_) || is_static_tf(connection.topic)) continue;
      const auto poses = ros::parse_poses(connection.type, (*message)->serialized());
      if (!poses) {  // it must not cost the others
        skipped_.push_back({ErrorCode::kCorruptInput,
                            reader_->place_of(**message),
                            "it is no " + connection.type,
                            {}});
        continue;
      }
      for (const ros::StampedPose& pose : *poses) take(pose);
      settle(false);
    }
    const PoseSample pose = ready_.front();
    ready_.pop_front();
    return in_our_axes(pose, topics_.pose_axes);
  }

  std::vector<Error> take_skipped() override { return std::exchange(skipped_, {}); }

 private:
  void take(const ros::StampedPose& pose) {
    const auto track =
        std::ranges::find_if(tracks_, [&](const TfTrack& tie) { return tie.is_of(pose); });
    if (track == tracks_.end()) return;
    const bool is_lowest = track == std::ranges::find_if(tracks_, &TfTrack::moves);
    if (is_lowest && track->newest() && *track->newest() - pose.stamp > kPatience) start_again();
    const PoseIntake intake = track->push(pose);
    if (!is_lowest) return;
    if (intake == PoseIntake::kAdded) waiting_.push_back(pose.stamp);
    // What is no pose is handed on as it is: the rig counts it.
    if (intake == PoseIntake::kNotFinite || intake == PoseIntake::kNotUnit)
      ready_.push_back({pose.stamp, pose.pose.R, pose.pose.t_m});
  }

  /// The clock was set back: what comes now has nothing to do with what was.
  void start_again() {
    settle(true);
    for (TfTrack& tie : tracks_) tie.clear();
  }

  /// Hands out what all ties are known for.
  void settle(bool is_over) {
    for (; !waiting_.empty(); waiting_.pop_front()) {
      const Stamp stamp = waiting_.front();
      const bool is_late =
          is_over || waiting_.back() - stamp > kPatience || waiting_.size() == kMostWaiting;
      const auto pose = at(stamp, is_late);
      if (!pose && !is_late) return;
      if (pose) ready_.push_back({stamp, pose->R, pose->t_m});
    }
  }

  [[nodiscard]] std::optional<ros::Pose> at(Stamp stamp, bool is_late) const {
    ros::Pose body;  // in the child of the tie above
    for (const TfTrack& tie : tracks_) {
      const auto T = tie.at(stamp, is_late);
      if (!T) return std::nullopt;
      body = {T->rotation() * body.t_m + T->translation(), (T->rotation() * body.R).normalized()};
    }
    return body;
  }

  RecordingReaderPtr reader_;
  std::optional<Error> fault_;  // of the file, while poses from before it wait
  std::vector<Error> skipped_;
  BagTopics topics_;
  std::vector<TfTrack> tracks_;  // from the vehicle upwards
  std::deque<Stamp> waiting_;    // of the lowest tie that moves, for the ties above
  std::deque<PoseSample> ready_;
};

}  // namespace

Expected<BagPoses> open_tf_poses(const std::filesystem::path& path, const BagTopics& topics) {
  auto first = open_recording(path);
  if (!first) return forward_error(std::move(first));
  auto chain = find_tf_chain(**first, topics);
  if (!chain) return forward_error(std::move(chain));
  auto again = open_recording(path);
  if (!again) return forward_error(std::move(again));
  const std::string topic = topics.pose.empty() ? "/tf" : topics.pose;
  std::string told = fmt::format("poses of {} in {} from {}", chain->body(), chain->world(), topic);
  return BagPoses{std::make_unique<TfPoses>(std::move(*again), topics, *chain), topic,
                  chain->body(), false, std::move(told)};
}

}  // namespace swiftlet
