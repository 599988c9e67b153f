// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag/bag_scan.hpp"
#include "swiftlet/source/bag/tf_chain.hpp"
#include "swiftlet/source/rig/mounts.hpp"

// The poses of recordings of ROS.

namespace swiftlet {
namespace {

/// Whether it is the pose of a frame; a type that does not tell whose pose it is has but one.
bool is_meant(const ros::StampedPose& pose, std::string_view frame) {
  return frame.empty() || pose.child.empty() || is_same_name(pose.child, frame);
}

class RosPoses final : public PoseStream {
 public:
  RosPoses(RecordingReaderPtr reader, std::string topic, std::string child, BodyAxes axes)
      : reader_(std::move(reader)),
        topic_(std::move(topic)),
        child_(std::move(child)),
        axes_(axes) {}

  Expected<std::optional<PoseSample>> next() override {
    while (true) {
      auto message = reader_->next();
      if (!message) return forward_error(std::move(message));
      if (!*message) return std::nullopt;
      if ((*message)->connection->topic != topic_) continue;
      const auto poses = ros::parse_poses((*message)->connection->type, (*message)->serialized());
      if (!poses) {  // it must not cost the others
        skipped_.push_back({ErrorCode::kCorruptInput,
                            reader_->place_of(**message),
                            "it is no " + (*message)->connection->type,
                            {}});
        continue;
      }
      const auto wanted = std::ranges::find_if(
          *poses, [&](const ros::StampedPose& pose) { return is_meant(pose, child_); });
      if (wanted != poses->end())
        return in_our_axes({wanted->stamp, wanted->pose.R, wanted->pose.t_m}, axes_);
    }
  }

  std::vector<Error> take_skipped() override { return std::exchange(skipped_, {}); }

 private:
  RecordingReaderPtr reader_;
  std::vector<Error> skipped_;
  std::string topic_;
  std::string child_;
  BodyAxes axes_;
};

/// A topic that may tell where the vehicle is.
struct PoseCandidate {
  std::string topic, type;
  std::set<std::string> frames{};  // whose poses it has, as far as it was read
  bool has_body = false;           // that of the frame that was asked for
  std::size_t poses = 0;
  Stamp first, last;  // when they were recorded

  [[nodiscard]] double rate_hz() const {
    const double span_s = seconds(last - first);
    return span_s > 0.0 ? static_cast<double>(poses - 1) / span_s : 0.0;
  }
  /// "/odom (nav_msgs/Odometry, 50.0 Hz)"
  [[nodiscard]] std::string text() const {
    return fmt::format("{} ({}, {:.1f} Hz)", topic, type, rate_hz());
  }
};

struct PoseSurvey {
  std::vector<PoseCandidate> candidates;
  bool is_tf = false;  // tf was asked for, or there is nothing else
};

void note_poses(const BagMessage& message, const std::string& body_frame,
                std::vector<PoseCandidate>& candidates) {
  constexpr std::size_t kMostFrames = 100, kMostCandidates = 64;
  const BagConnection& connection = *message.connection;
  const auto poses = ros::parse_poses(connection.type, message.serialized());
  if (!poses || poses->empty()) return;
  auto found = std::ranges::find(candidates, connection.topic, &PoseCandidate::topic);
  if (found == candidates.end()) {
    if (candidates.size() == kMostCandidates) return;
    candidates.push_back({.topic = connection.topic,
                          .type = connection.type,
                          .first = message.record_time,
                          .last = message.record_time});
    found = candidates.end() - 1;
  }
  ++found->poses;
  found->last = message.record_time;
  const ros::StampedPose& pose = poses->front();
  found->has_body |= is_meant(pose, body_frame);
  if (found->frames.size() < kMostFrames) found->frames.insert(pose.child);
}

/// Reads on until one has plainly poses, and some more, so that another beside it is seen.
Expected<PoseSurvey> survey_poses(RecordingReader& reader, const BagTopics& topics) {
  constexpr std::size_t kPlainly = 10;
  constexpr std::uint64_t kBytesToCompare = 60U << 20U;  // an image has about one
  PoseSurvey survey;
  bool has_tf = false;
  std::optional<std::uint64_t> enough;  // bytes
  auto scanned = scan_bag(reader, [&](const BagMessage& message) {
    if (enough && reader.bytes_read() > *enough) return true;
    const BagConnection& connection = *message.connection;
    const bool is_tf = ros::is_tf_type(connection.type);
    has_tf |= is_tf;
    if (topics.pose.empty() ? is_tf : !is_same_name(connection.topic, topics.pose)) return false;
    survey.is_tf |= is_tf;
    if (!ros::is_pose_type(connection.type) || is_tf) return survey.is_tf;
    note_poses(message, topics.body_frame, survey.candidates);
    const auto plain = std::ranges::find_if(survey.candidates, [&](const PoseCandidate& c) {
      return c.has_body && c.poses >= (topics.pose.empty() ? kPlainly : 1);
    });
    if (plain == survey.candidates.end()) return false;
    if (!enough) enough = reader.bytes_read() + kBytesToCompare;
    return !topics.pose.empty();
  });
  if (!scanned && survey.candidates.empty() && !has_tf) return forward_error(std::move(scanned));
  if (survey.candidates.empty() && topics.pose.empty()) survey.is_tf = has_tf;
  return survey;
}

tl::unexpected<Error> no_poses(const RecordingReader& reader, const BagTopics& topics) {
  return no_such_topic(reader,
                       topics.pose.empty() ? "it holds no poses (Odometry, PoseStamped, "
                                             "PoseWithCovarianceStamped, TransformStamped, tf)"
                                           : "it has no poses on " + topics.pose,
                       "choose a topic with --pose-topic", topics.pose);
}

/// The one that tells where the vehicle is, all the time: a goal or a first guess is told once.
Expected<PoseCandidate> choose_poses(const RecordingReader& reader,
                                     std::vector<PoseCandidate> candidates,
                                     const std::string& body_frame) {
  std::set<std::string> frames;
  std::string topics;
  for (const PoseCandidate& candidate : candidates) {
    frames.insert(candidate.frames.begin(), candidate.frames.end());
    topics += (topics.empty() ? "" : ", ") + candidate.topic;
  }
  std::erase_if(candidates, [](const PoseCandidate& c) { return !c.has_body; });
  if (candidates.empty()) {
    return fail(ErrorCode::kNotFound, fmt::format("{} ({})", reader.name(), topics),
                fmt::format("there is no frame {}", body_frame),
                names_instead(body_frame, std::vector(frames.begin(), frames.end())));
  }
  const auto is_rare = [](const PoseCandidate& c) { return c.poses < 3 || c.rate_hz() < 1.0; };
  if (!std::ranges::all_of(candidates, is_rare)) std::erase_if(candidates, is_rare);
  if (candidates.size() == 1) return std::move(candidates.front());
  std::string texts;
  for (const PoseCandidate& c : candidates) texts += (texts.empty() ? "" : ", ") + c.text();
  return fail(ErrorCode::kUsage, reader.name(),
              "several of its topics may tell where the vehicle was: " + texts,
              "choose a topic with --pose-topic");
}

std::string told(const PoseCandidate& chosen, const std::string& child,
                 const std::vector<PoseCandidate>& candidates) {
  std::string others;
  for (const PoseCandidate& candidate : candidates) {
    if (candidate.topic != chosen.topic)
      others += (others.empty() ? "; not from " : ", ") + candidate.topic;
  }
  return fmt::format("poses{}{} from {} ({}){}", child.empty() ? "" : " of ", child, chosen.topic,
                     chosen.type, others);
}

}  // namespace

Expected<BagPoses> open_ros_poses(const std::filesystem::path& path, const BagTopics& topics) {
  auto first = open_recording(path);
  if (!first) return forward_error(std::move(first));
  auto survey = survey_poses(**first, topics);
  if (!survey) return forward_error(std::move(survey));
  if (survey->is_tf) return open_tf_poses(path, topics);
  if (survey->candidates.empty()) return no_poses(**first, topics);
  auto chosen = choose_poses(**first, survey->candidates, topics.body_frame);
  if (!chosen) return forward_error(std::move(chosen));
  auto again = open_recording(path);
  if (!again) return forward_error(std::move(again));
  const std::string child = topics.body_frame.empty() ? *chosen->frames.begin() : topics.body_frame;
  return BagPoses{std::make_unique<RosPoses>(std::move(*again), chosen->topic, topics.body_frame,
                                             topics.pose_axes),
                  chosen->topic, child, false, told(*chosen, child, survey->candidates)};
}

}  // namespace swiftlet
