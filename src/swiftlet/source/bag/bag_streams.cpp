// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag/bag_streams.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <set>
#include <span>
#include <system_error>
#include <utility>
#include <vector>

#include "swiftlet/bag/byte_source.hpp"
#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/base/nearest_name.hpp"
#include "swiftlet/source/bag/bag_scan.hpp"
#include "swiftlet/source/bag/depth_decoder.hpp"
#include "swiftlet/source/bag/tf_chain.hpp"
#include "swiftlet/source/rig/frame_tree.hpp"

namespace swiftlet {
namespace {

/// Whether a file is text, by its first bytes: neither zeros nor a recording.
Expected<bool> is_text(const std::filesystem::path& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none)) return false;
  auto bytes = open_file_bytes(path);
  if (!bytes) return forward_error(std::move(bytes));
  std::array<std::byte, 512> start{};
  const auto head = std::span(start).first(std::min<std::uint64_t>(512, (*bytes)->size()));
  if (auto read = (*bytes)->read(0, head); !read) return forward_error(std::move(read));
  return recording_kind(head) == RecordingKind::kNone &&
         std::ranges::find(head, std::byte{0}) == head.end();
}

}  // namespace

std::string names_instead(std::string_view typed, const std::vector<std::string>& known) {
  constexpr std::size_t kMost = 20;
  const auto nearest = nearest_name(typed, known);
  const std::size_t shown = std::min(known.size(), kMost);
  return fmt::format("{}it has {}{}", nearest ? "did you mean " + *nearest + "? " : "",
                     fmt::join(std::span(known).first(shown), ", "),
                     shown < known.size() ? fmt::format(" and {} more", known.size() - shown) : "");
}

tl::unexpected<Error> no_such_topic(const RecordingReader& reader, std::string_view what,
                                    std::string_view remedy, std::string_view typed) {
  std::set<std::string> topics;
  for (const auto& [id, connection] : reader.connections()) {
    if (ros::is_pose_type(connection.type) || is_depth_type(connection.type) ||
        connection.type == "sensor_msgs/CameraInfo" || connection.topic.ends_with("/data"))
      topics.insert(connection.topic);
  }
  const std::vector<std::string> known(topics.begin(), topics.end());
  return fail(ErrorCode::kNotFound, reader.name(), std::string(what),
              fmt::format("{}; {} (`swiftlet info` lists all topics)", remedy,
                          topics.empty() ? "it has neither images nor poses"
                                         : names_instead(typed, known)));
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
  auto as_text = is_text(path);
  if (!as_text) return forward_error(std::move(as_text));
  if (*as_text && path.extension() != ".bag") return open_text_poses(path, topics);
  if (topics.pose.empty()) {
    auto recorded = open_realsense_poses(path);
    if (!recorded) return forward_error(std::move(recorded));
    if (*recorded) return std::move(**recorded);
  }
  return open_ros_poses(path, topics);
}

Expected<Transform<Body, Camera>> mount_from_tf(const std::filesystem::path& path,
                                                const std::string& body_frame,
                                                const std::string& camera_frame) {
  const std::string body = std::string(plain_name(body_frame));
  const std::string camera = std::string(plain_name(camera_frame));
  if (body == camera) return Transform<Body, Camera>{};
  auto reader = open_recording(path);
  if (!reader) return forward_error(std::move(reader));
  FrameTree tree;
  auto found = scan_bag(**reader, [&](const BagMessage& message) {
    const std::string& topic = message.connection->topic;
    if (!is_static_tf(topic)) return false;
    const auto poses = ros::parse_poses(message.connection->type, message.serialized());
    if (!poses) return false;
    for (const ros::StampedPose& pose : *poses) {
      // One that is no transform ties nothing; if it was needed, the chain is not found.
      (void)tree.add(std::string(plain_name(pose.parent)), std::string(plain_name(pose.child)),
                     pose.pose.R, pose.pose.t_m);
    }
    return tree.mount(body, camera).has_value();
  });
  if (!found) return forward_error(std::move(found));
  if (const auto mount = tree.mount(body, camera)) return *mount;
  const std::vector<std::string> names = tree.names();
  return fail(
      ErrorCode::kNotFound, path.string(),
      fmt::format("/tf_static does not tell where the camera '{}' sits on '{}': {}", camera_frame,
                  body_frame, names.empty() ? "it is empty" : names_instead(body, names)),
      "name the vehicle with --body-frame, or describe the mount in a rig file and give it with "
      "--rig (docs/rig.md)");
}

}  // namespace swiftlet
