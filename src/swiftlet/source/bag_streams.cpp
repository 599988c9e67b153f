// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag_streams.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <set>
#include <utility>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag_scan.hpp"
#include "swiftlet/source/frame_tree.hpp"

namespace swiftlet {
namespace {

// Static transforms are recorded when the recorder starts; a chunk is about one image.
constexpr std::uint64_t kChunksWithStatics = 200;

std::string without_slash(std::string frame) {
  if (frame.starts_with('/')) frame.erase(0, 1);  // tf1 wrote "/base_link" for base_link
  return frame;
}

}  // namespace

tl::unexpected<Error> no_such_topic(const BagReader& reader, std::string_view what,
                                    std::string_view remedy) {
  std::set<std::string> topics;
  for (const auto& [id, connection] : reader.connections()) {
    const bool is_pose =
        std::ranges::find(ros::kPoseTypes, connection.type) != ros::kPoseTypes.end();
    if (is_pose || connection.type == "sensor_msgs/Image" || connection.topic.ends_with("/data"))
      topics.insert(connection.topic);
  }
  return fail(ErrorCode::kNotFound, reader.bytes().name(), std::string(what),
              fmt::format("{}; it has {} (`swiftlet info` lists all topics)", remedy,
                          topics.empty() ? "neither images nor poses"
                                         : fmt::format("{}", fmt::join(topics, ", "))));
}

Expected<BagDepth> open_bag_depth(const std::filesystem::path& path, const BagTopics& topics) {
  if (topics.depth.empty()) {
    auto recorded = open_realsense_depth(path);
    if (!recorded) return forward_error(std::move(recorded));
    if (*recorded) return std::move(**recorded);
  }
  return open_ros_depth(path, topics);
}

Expected<BagPoses> open_bag_poses(const std::filesystem::path& path, const BagTopics& topics) {
  if (path.extension() == ".txt") return open_text_poses(path, topics);
  if (topics.pose.empty()) {
    auto recorded = open_realsense_poses(path);
    if (!recorded) return forward_error(std::move(recorded));
    if (*recorded) return std::move(**recorded);
  }
  return open_ros_poses(path, topics);
}

Expected<std::optional<Transform<Body, Camera>>> mount_from_tf(const std::filesystem::path& path,
                                                               const std::string& body_frame,
                                                               const std::string& camera_frame) {
  auto reader = open_bag(path);
  if (!reader) return forward_error(std::move(reader));
  FrameTree tree;
  const std::string body = without_slash(body_frame);
  const std::string camera = without_slash(camera_frame);
  auto found = scan_bag(*reader, [&](const BagMessage& message) {
    const std::string& topic = message.connection->topic;
    if (topic != "/tf_static") return reader->chunks_read() > kChunksWithStatics;
    const auto poses = ros::parse_poses(message.connection->type, message.data);
    if (!poses) return false;
    for (const ros::StampedPose& pose : *poses) {
      // One that is no transform ties nothing; if it was needed, the chain is not found.
      (void)tree.add(without_slash(pose.parent), without_slash(pose.child), pose.pose.R,
                     pose.pose.t_m);
    }
    return tree.mount(body, camera).has_value();
  });
  if (!found) return forward_error(std::move(found));
  return tree.mount(body, camera);
}

}  // namespace swiftlet
