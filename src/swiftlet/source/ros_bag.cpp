// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <string>
#include <utility>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag_scan.hpp"
#include "swiftlet/source/depth_message.hpp"
#include "swiftlet/source/mounts.hpp"

// Plain ROS 1 bags, as of realsense-ros or OpenLORIS-Scene.

namespace swiftlet {
namespace {

constexpr std::string_view kImageType = "sensor_msgs/Image";
constexpr std::string_view kInfoType = "sensor_msgs/CameraInfo";

class RosDepth final : public DepthStream {
 public:
  RosDepth(BagReader reader, std::string topic, const PinholeIntrinsics& intrinsics, float unit_m)
      : reader_(std::move(reader)),
        topic_(std::move(topic)),
        intrinsics_(intrinsics),
        unit_m_(unit_m) {}

  Expected<std::optional<DepthFrame>> next() override {
    while (true) {
      auto message = reader_.next();
      if (!message) return forward_error(std::move(message));
      if (!*message) return std::nullopt;
      if ((*message)->connection->topic == topic_) return decoded(**message);
    }
  }

 private:
  Expected<std::optional<DepthFrame>> decoded(const BagMessage& message) {
    const auto image = ros::parse_image(message.data);
    if (!image)
      return fail(ErrorCode::kCorruptInput, place_of(reader_, message), "it is no image message");
    auto depth = depth_from_message(*image, unit_m_);
    if (!depth)
      return fail(ErrorCode::kCorruptInput, place_of(reader_, message), std::move(depth.error()));
    if (depth->raw.width() != intrinsics_.width() || depth->raw.height() != intrinsics_.height())
      return fail(ErrorCode::kCorruptInput, place_of(reader_, message),
                  "the image has another size than its CameraInfo");
    return DepthFrame{image->header.stamp, std::move(*depth), intrinsics_};
  }

  BagReader reader_;
  std::string topic_;
  PinholeIntrinsics intrinsics_;
  float unit_m_;
};

bool is_tf(std::string_view type) { return type == "tf2_msgs/TFMessage" || type == "tf/tfMessage"; }

class RosPoses final : public PoseStream {
 public:
  RosPoses(BagReader reader, std::string topic, std::string child, BodyAxes axes)
      : reader_(std::move(reader)),
        topic_(std::move(topic)),
        child_(std::move(child)),
        axes_(axes) {}

  Expected<std::optional<PoseSample>> next() override {
    while (true) {
      auto message = reader_.next();
      if (!message) return forward_error(std::move(message));
      if (!*message) return std::nullopt;
      if ((*message)->connection->topic != topic_) continue;
      const auto poses = ros::parse_poses((*message)->connection->type, (*message)->data);
      if (!poses)
        return fail(ErrorCode::kCorruptInput, place_of(reader_, **message),
                    "it is no " + (*message)->connection->type);
      const auto wanted = std::ranges::find_if(*poses, [&](const ros::StampedPose& pose) {
        return child_.empty() || pose.child == child_;
      });
      if (wanted != poses->end())
        return in_our_axes({wanted->stamp, wanted->pose.R, wanted->pose.t_m}, axes_);
    }
  }

 private:
  BagReader reader_;
  std::string topic_;
  std::string child_;
  BodyAxes axes_;
};

struct FoundImages {
  std::string topic;
  std::string frame_id;
};

Expected<FoundImages> find_images(BagReader& reader, const BagTopics& topics) {
  FoundImages found;
  auto is_found = scan_bag(reader, [&](const BagMessage& message) {
    const BagConnection& connection = *message.connection;
    if (connection.type != kImageType) return false;
    if (!topics.depth.empty() && connection.topic != topics.depth) return false;
    const auto image = ros::parse_image(message.data);
    if (!image || (topics.depth.empty() && !may_be_depth(image->encoding))) return false;
    found = {connection.topic, std::string(image->header.frame_id)};
    return true;
  });
  if (!is_found) return forward_error(std::move(is_found));
  if (*is_found) return found;
  return no_such_topic(reader,
                       topics.depth.empty() ? "it holds no depth images (16UC1, mono16 or 32FC1)"
                                            : "it has no images on " + topics.depth,
                       "choose a topic with --depth-topic");
}

Expected<PinholeIntrinsics> find_intrinsics(BagReader& reader, const std::string& topic) {
  Expected<PinholeIntrinsics> intrinsics = tl::make_unexpected(Error{});
  auto is_found = scan_bag(reader, [&](const BagMessage& message) {
    if (message.connection->topic != topic || message.connection->type != kInfoType) return false;
    const auto info = ros::parse_camera_info(message.data);
    intrinsics =
        info ? intrinsics_from_message(*info, place_of(reader, message))
             : Expected<PinholeIntrinsics>(fail(ErrorCode::kCorruptInput, place_of(reader, message),
                                                "it is no CameraInfo"));
    return true;
  });
  if (!is_found) return forward_error(std::move(is_found));
  if (*is_found) return intrinsics;
  return no_such_topic(reader, "it has no CameraInfo on " + topic,
                       "choose a topic with --info-topic");
}

}  // namespace

Expected<BagDepth> open_ros_depth(const std::filesystem::path& path, const BagTopics& topics) {
  auto first = open_bag(path);
  if (!first) return forward_error(std::move(first));
  auto images = find_images(*first, topics);
  if (!images) return forward_error(std::move(images));

  auto second = open_bag(path);
  if (!second) return forward_error(std::move(second));
  const std::string beside = images->topic.substr(0, images->topic.rfind('/')) + "/camera_info";
  auto intrinsics = find_intrinsics(*second, topics.info.empty() ? beside : topics.info);
  if (!intrinsics) return forward_error(std::move(intrinsics));

  auto third = open_bag(path);
  if (!third) return forward_error(std::move(third));
  return BagDepth{std::make_unique<RosDepth>(std::move(*third), images->topic, *intrinsics,
                                             static_cast<float>(topics.depth_unit_m)),
                  images->topic, images->frame_id, *intrinsics, std::nullopt};
}

Expected<BagPoses> open_ros_poses(const std::filesystem::path& path, const BagTopics& topics) {
  auto first = open_bag(path);
  if (!first) return forward_error(std::move(first));
  BagPoses found;
  auto is_found = scan_bag(*first, [&](const BagMessage& message) {
    const BagConnection& connection = *message.connection;
    const bool is_pose =
        std::ranges::find(ros::kPoseTypes, connection.type) != ros::kPoseTypes.end();
    // A tf topic holds many frames: nobody but the user knows which is the vehicle.
    const bool is_meant =
        topics.pose.empty() ? !is_tf(connection.type) : connection.topic == topics.pose;
    if (!is_pose || !is_meant) return false;
    const auto poses = ros::parse_poses(connection.type, message.data);
    if (!poses || poses->empty()) return false;
    found.topic = connection.topic;
    found.child_frame = topics.body_frame.empty() ? poses->front().child : topics.body_frame;
    return !is_tf(connection.type) || !topics.body_frame.empty();
  });
  if (!is_found) return forward_error(std::move(is_found));
  if (!*is_found && !found.topic.empty())
    return fail(ErrorCode::kUsage, found.topic, "a tf topic holds the poses of many frames",
                "say which is the vehicle with --body-frame, as in base_link");
  if (!*is_found)
    return no_such_topic(*first,
                         topics.pose.empty() ? "it holds no poses (Odometry, PoseStamped, "
                                               "PoseWithCovarianceStamped, TransformStamped)"
                                             : "it has no poses on " + topics.pose,
                         "choose a topic with --pose-topic");
  auto again = open_bag(path);
  if (!again) return forward_error(std::move(again));
  found.stream = std::make_unique<RosPoses>(std::move(*again), found.topic, topics.body_frame,
                                            topics.pose_axes);
  return found;
}

}  // namespace swiftlet
