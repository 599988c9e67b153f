// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>
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
      if (!poses)
        return fail(ErrorCode::kCorruptInput, reader_->place_of(**message),
                    "it is no " + (*message)->connection->type);
      const auto wanted = std::ranges::find_if(
          *poses, [&](const ros::StampedPose& pose) { return is_meant(pose, child_); });
      if (wanted != poses->end())
        return in_our_axes({wanted->stamp, wanted->pose.R, wanted->pose.t_m}, axes_);
    }
  }

 private:
  RecordingReaderPtr reader_;
  std::string topic_;
  std::string child_;
  BodyAxes axes_;
};

struct FoundPoses {
  std::string topic, type, child;
  bool is_complete = false;  // nothing more has to be found
  bool has_tf = false;
  std::set<std::string> frames{};  // that it has, as far as it was read
};

/// Looks at a message of poses; true if that is all there is to be known.
bool note_poses(const BagConnection& connection, const std::vector<ros::StampedPose>& poses,
                const BagTopics& topics, FoundPoses& found) {
  constexpr std::size_t kMostFrames = 100;
  if (poses.empty() || (!found.topic.empty() && found.topic != connection.topic)) return false;
  found.topic = connection.topic;
  found.type = connection.type;
  for (const ros::StampedPose& pose : poses) {
    if (found.frames.size() < kMostFrames) found.frames.insert(pose.child);
    if (!topics.body_frame.empty() && !is_meant(pose, topics.body_frame)) continue;
    found.child = topics.body_frame.empty() ? pose.child : topics.body_frame;
    found.is_complete = true;
  }
  return found.is_complete;
}

Expected<FoundPoses> find_poses(RecordingReader& reader, const BagTopics& topics) {
  FoundPoses found;
  auto is_found = scan_bag(reader, [&](const BagMessage& message) {
    const BagConnection& connection = *message.connection;
    const bool is_pose =
        std::ranges::find(ros::kPoseTypes, connection.type) != ros::kPoseTypes.end();
    const bool is_tf = is_tf_type(connection.type);
    found.has_tf |= is_tf;
    const bool is_asked =
        topics.pose.empty() ? !is_tf : is_same_name(connection.topic, topics.pose);
    if (!is_pose || !is_asked) return false;
    if (is_tf) {
      found.type = connection.type;
      return true;
    }
    const auto poses = ros::parse_poses(connection.type, message.serialized());
    return poses && note_poses(connection, *poses, topics, found);
  });
  if (!is_found) return forward_error(std::move(is_found));
  if (found.is_complete || is_tf_type(found.type)) return found;
  if (found.topic.empty() && found.has_tf && topics.pose.empty()) {
    found.type = "tf2_msgs/TFMessage";
    return found;
  }
  if (found.topic.empty()) {
    return no_such_topic(reader,
                         topics.pose.empty() ? "it holds no poses (Odometry, PoseStamped, "
                                               "PoseWithCovarianceStamped, TransformStamped, tf)"
                                             : "it has no poses on " + topics.pose,
                         "choose a topic with --pose-topic", topics.pose);
  }
  const std::vector<std::string> frames(found.frames.begin(), found.frames.end());
  return fail(ErrorCode::kNotFound, fmt::format("{} ({})", reader.name(), found.topic),
              fmt::format("there is no frame {}", topics.body_frame),
              names_instead(topics.body_frame, frames));
}

std::string told(const FoundPoses& found, const RecordingReader& reader) {
  std::string others;
  for (const auto& [id, connection] : reader.connections()) {
    const bool is_other =
        connection.topic != found.topic && !is_tf_type(connection.type) &&
        std::ranges::find(ros::kPoseTypes, connection.type) != ros::kPoseTypes.end();
    if (is_other) others += (others.empty() ? "; not from " : ", ") + connection.topic;
  }
  return fmt::format("poses{}{} from {} ({}){}", found.child.empty() ? "" : " of ", found.child,
                     found.topic, found.type, others);
}

}  // namespace

Expected<BagPoses> open_ros_poses(const std::filesystem::path& path, const BagTopics& topics) {
  auto first = open_recording(path);
  if (!first) return forward_error(std::move(first));
  auto found = find_poses(**first, topics);
  if (!found) return forward_error(std::move(found));
  if (is_tf_type(found->type)) return open_tf_poses(path, topics);
  auto again = open_recording(path);
  if (!again) return forward_error(std::move(again));
  return BagPoses{std::make_unique<RosPoses>(std::move(*again), found->topic, topics.body_frame,
                                             topics.pose_axes),
                  found->topic, found->child, false, told(*found, **first)};
}

}  // namespace swiftlet
