// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/ros_messages.hpp"

#include <algorithm>
#include <utility>

#include "swiftlet/bag/messages/message_cursor.hpp"

namespace swiftlet::ros {
namespace {

// header.frame_id of images that the SDK has put its depth unit behind; it is a version, no frame.
constexpr std::string_view kHasDepthUnit = "1";
constexpr std::size_t kMaxDistortion = 64;
constexpr std::size_t kMaxFields = 256;

Header read_header(MessageCursor& cursor) {
  Header header;
  if (cursor.is_ros1()) header.seq = cursor.read<std::uint32_t>();
  header.stamp = cursor.read_time();
  header.frame_id = cursor.read_string();
  return header;
}

Pose read_pose(MessageCursor& cursor) {
  const auto t = cursor.read_array<double, 3>();
  const auto q = cursor.read_array<double, 4>();  // x, y, z, w
  return {{t[0], t[1], t[2]}, {q[3], q[0], q[1], q[2]}};
}

StampedPose read_stamped(MessageCursor& cursor, bool has_child) {
  const Header header = read_header(cursor);
  StampedPose stamped{header.stamp, std::string(header.frame_id), {}, {}};
  if (has_child) stamped.child = cursor.read_string();
  stamped.pose = read_pose(cursor);
  return stamped;
}

constexpr std::size_t kCovariance = 36;  // numbers
constexpr std::size_t kTwist = 6;

}  // namespace

std::optional<Image> parse_image(const SerializedMessage& message) {
  MessageCursor cursor(message);
  Image image;
  image.header = read_header(cursor);
  image.height = cursor.read<std::uint32_t>();
  image.width = cursor.read<std::uint32_t>();
  image.encoding = cursor.read_string();
  image.is_big_endian = cursor.read<std::uint8_t>() != 0;
  image.step = cursor.read<std::uint32_t>();
  image.data = cursor.read_bytes();
  if (cursor.is_ros1() && cursor.left() == sizeof(float) && image.header.frame_id == kHasDepthUnit)
    image.depth_unit_m = cursor.read<float>();
  if (!cursor.is_whole()) return std::nullopt;
  return image;
}

std::optional<CompressedImage> parse_compressed_image(const SerializedMessage& message) {
  MessageCursor cursor(message);
  CompressedImage image;
  image.header = read_header(cursor);
  image.format = cursor.read_string();
  image.data = cursor.read_bytes();
  if (!cursor.is_whole()) return std::nullopt;
  return image;
}

std::optional<PointCloud> parse_point_cloud(const SerializedMessage& message) {
  MessageCursor cursor(message);
  PointCloud cloud;
  cloud.header = read_header(cursor);
  cloud.height = cursor.read<std::uint32_t>();
  cloud.width = cursor.read<std::uint32_t>();
  const auto fields = cursor.read_struct_count();
  if (fields > kMaxFields) return std::nullopt;
  for (std::uint32_t i = 0; i < fields; ++i) {
    PointField field;
    field.name = cursor.read_string();
    field.offset = cursor.read<std::uint32_t>();
    field.datatype = cursor.read<std::uint8_t>();
    field.count = cursor.read<std::uint32_t>();
    cloud.fields.push_back(field);
  }
  cloud.is_big_endian = cursor.read<std::uint8_t>() != 0;
  cloud.point_step = cursor.read<std::uint32_t>();
  cloud.row_step = cursor.read<std::uint32_t>();
  cloud.data = cursor.read_bytes();
  cursor.skip<std::uint8_t>(1);  // is_dense
  if (!cursor.is_whole()) return std::nullopt;
  return cloud;
}

std::optional<CameraInfo> parse_camera_info(const SerializedMessage& message) {
  MessageCursor cursor(message);
  CameraInfo info;
  info.header = read_header(cursor);
  info.height = cursor.read<std::uint32_t>();
  info.width = cursor.read<std::uint32_t>();
  info.distortion_model = cursor.read_string();
  const auto coefficients = cursor.read<std::uint32_t>();
  if (coefficients > kMaxDistortion) return std::nullopt;
  for (std::uint32_t i = 0; i < coefficients; ++i) info.D.push_back(cursor.read<double>());
  info.K = cursor.read_array<double, 9>();
  if (!cursor.is_good()) return std::nullopt;
  cursor.skip<double>(9 + 12);  // R and P are of no use here
  const auto [bin_x, bin_y, x, y, height, width] = cursor.read_array<std::uint32_t, 6>();
  if (!cursor.is_good()) return info;  // a short one, of a writer that stops at K
  info.binning_x = bin_x;
  info.binning_y = bin_y;
  info.region = {x, y, height, width};
  return info;
}

std::optional<Pose> parse_transform(const SerializedMessage& message) {
  MessageCursor cursor(message);
  const Pose pose = read_pose(cursor);
  if (!cursor.is_whole()) return std::nullopt;
  return pose;
}

std::optional<KeyValue> parse_key_value(const SerializedMessage& message) {
  MessageCursor cursor(message);
  KeyValue pair;
  pair.key = cursor.read_string();
  pair.value = cursor.read_string();
  if (!cursor.is_whole()) return std::nullopt;
  return pair;
}

std::optional<float> parse_float32(const SerializedMessage& message) {
  MessageCursor cursor(message);
  const auto value = cursor.read<float>();
  if (!cursor.is_whole()) return std::nullopt;
  return value;
}

std::optional<std::uint32_t> parse_uint32(const SerializedMessage& message) {
  MessageCursor cursor(message);
  const auto value = cursor.read<std::uint32_t>();
  if (!cursor.is_whole()) return std::nullopt;
  return value;
}

std::vector<std::string> parse_frames(std::string_view type, const SerializedMessage& message) {
  std::vector<std::string> frames;
  if (is_tf_type(type)) {
    for (StampedPose& pose : parse_poses(type, message).value_or(std::vector<StampedPose>{}))
      frames.push_back(std::move(pose.child));
    return frames;
  }
  const bool has_header = type.starts_with("sensor_msgs/") || type == "nav_msgs/Odometry" ||
                          (type.starts_with("geometry_msgs/") && type.ends_with("Stamped"));
  if (!has_header) return frames;
  MessageCursor cursor(message);
  const Header header = read_header(cursor);
  if (cursor.is_good() && !header.frame_id.empty()) frames.emplace_back(header.frame_id);
  return frames;
}

std::optional<std::vector<StampedPose>> parse_poses(std::string_view type,
                                                    const SerializedMessage& message) {
  MessageCursor cursor(message);
  std::vector<StampedPose> poses;
  if (is_tf_type(type)) {
    const auto count = cursor.read_struct_count();
    for (std::uint32_t i = 0; i < count && cursor.is_good(); ++i)
      poses.push_back(read_stamped(cursor, true));
  } else if (type == "nav_msgs/Odometry") {
    poses.push_back(read_stamped(cursor, true));
    cursor.skip<double>(kCovariance + kTwist + kCovariance);
  } else if (type == "geometry_msgs/PoseStamped") {
    poses.push_back(read_stamped(cursor, false));
  } else if (type == "geometry_msgs/PoseWithCovarianceStamped") {
    poses.push_back(read_stamped(cursor, false));
    cursor.skip<double>(kCovariance);
  } else if (type == "geometry_msgs/TransformStamped") {
    poses.push_back(read_stamped(cursor, true));
  } else {
    return std::nullopt;
  }
  if (!cursor.is_whole()) return std::nullopt;
  return poses;
}

bool is_pose_type(std::string_view type) {
  return std::ranges::find(kPoseTypes, type) != kPoseTypes.end();
}

bool is_tf_type(std::string_view type) {
  return type == "tf2_msgs/TFMessage" || type == "tf/tfMessage";
}

}  // namespace swiftlet::ros
