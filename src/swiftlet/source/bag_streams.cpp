// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag_streams.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <utility>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag_scan.hpp"

namespace swiftlet {
namespace {

// Static transforms are recorded when the recorder starts; a chunk is about one image.
constexpr std::uint64_t kChunksWithStatics = 200;

/// The tree of frames: T_to_from by the frame it starts from.
class FrameTree {
 public:
  struct Anywhere {};
  using Hop = Transform<Anywhere, Anywhere>;

  void add(const ros::StampedPose& pose) {
    const auto T = Hop::from(pose.pose.R, pose.pose.t_m);
    if (!T) return;
    hops_[pose.child].insert_or_assign(pose.parent, *T);
    hops_[pose.parent].insert_or_assign(pose.child, T->inverse());
  }

  /// The pose of frame `from` in frame `to`.
  [[nodiscard]] std::optional<Hop> find(const std::string& to, const std::string& from) const {
    std::map<std::string, Hop> reached{{from, Hop{}}};
    for (std::deque<std::string> open{from}; !open.empty(); open.pop_front()) {
      const Hop T_here_from = reached.at(open.front());
      if (open.front() == to) return T_here_from;
      const auto here = hops_.find(open.front());
      if (here == hops_.end()) continue;
      for (const auto& [next, T_next_here] : here->second) {
        if (reached.emplace(next, T_next_here * T_here_from).second) open.push_back(next);
      }
    }
    return std::nullopt;
  }

 private:
  std::map<std::string, std::map<std::string, Hop>> hops_;
};

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
    for (ros::StampedPose pose : *poses) {
      pose.parent = without_slash(std::move(pose.parent));
      pose.child = without_slash(std::move(pose.child));
      tree.add(pose);
    }
    return tree.find(body, camera).has_value();
  });
  if (!found) return forward_error(std::move(found));
  const auto T = tree.find(body, camera);
  if (!T) return std::nullopt;
  return Transform<Body, Camera>::trusted(T->rotation(), T->translation());
}

}  // namespace swiftlet
