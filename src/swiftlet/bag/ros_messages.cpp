// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/ros_messages.hpp"

#include <algorithm>

#include "swiftlet/bag/byte_cursor.hpp"

namespace swiftlet::ros {
namespace {

// header.frame_id of images that the SDK has put its depth unit behind; it is a version, no frame.
constexpr std::string_view kHasDepthUnit = "1";
constexpr std::size_t kMaxDistortion = 64;

Stamp read_time(ByteCursor& cursor) {
  const std::int64_t s = cursor.read<std::uint32_t>();
  const std::int64_t ns = cursor.read<std::uint32_t>();
  return {s * 1'000'000'000 + ns};
}

Header read_header(ByteCursor& cursor) {
  Header header;
  header.seq = cursor.read<std::uint32_t>();
  header.stamp = read_time(cursor);
  header.frame_id = cursor.read_string();
  return header;
}

Pose read_pose(ByteCursor& cursor) {
  const auto t = cursor.read_array<double, 3>();
  const auto q = cursor.read_array<double, 4>();  // x, y, z, w
  return {{t[0], t[1], t[2]}, {q[3], q[0], q[1], q[2]}};
}

bool is_whole(const ByteCursor& cursor) { return cursor.is_good() && cursor.left() == 0; }

StampedPose read_stamped(ByteCursor& cursor, bool has_child) {
  const Header header = read_header(cursor);
  StampedPose stamped{header.stamp, std::string(header.frame_id), {}, {}};
  if (has_child) stamped.child = cursor.read_string();
  stamped.pose = read_pose(cursor);
  return stamped;
}

constexpr std::size_t kCovarianceBytes = 36 * sizeof(double);
constexpr std::size_t kTwistBytes = 6 * sizeof(double);

}  // namespace

std::optional<Image> parse_image(Bytes bytes) {
  ByteCursor cursor(bytes);
  Image image;
  image.header = read_header(cursor);
  image.height = cursor.read<std::uint32_t>();
  image.width = cursor.read<std::uint32_t>();
  image.encoding = cursor.read_string();
  image.is_big_endian = cursor.read<std::uint8_t>() != 0;
  image.step = cursor.read<std::uint32_t>();
  image.data = cursor.take(cursor.read<std::uint32_t>());
  if (cursor.left() == sizeof(float) && image.header.frame_id == kHasDepthUnit)
    image.depth_unit_m = cursor.read<float>();
  if (!is_whole(cursor)) return std::nullopt;
  return image;
}

std::optional<CameraInfo> parse_camera_info(Bytes bytes) {
  ByteCursor cursor(bytes);
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
  cursor.skip((9 + 12) * sizeof(double));  // R and P are of no use here
  const auto [bin_x, bin_y, x, y, height, width] = cursor.read_array<std::uint32_t, 6>();
  if (!cursor.is_good()) return info;  // a short one, of a writer that stops at K
  info.binning_x = bin_x;
  info.binning_y = bin_y;
  info.region = {x, y, height, width};
  return info;
}

std::optional<Pose> parse_transform(Bytes bytes) {
  ByteCursor cursor(bytes);
  const Pose pose = read_pose(cursor);
  if (!is_whole(cursor)) return std::nullopt;
  return pose;
}

std::optional<KeyValue> parse_key_value(Bytes bytes) {
  ByteCursor cursor(bytes);
  KeyValue pair;
  pair.key = cursor.read_string();
  pair.value = cursor.read_string();
  if (!is_whole(cursor)) return std::nullopt;
  return pair;
}

std::optional<float> parse_float32(Bytes bytes) {
  ByteCursor cursor(bytes);
  const auto value = cursor.read<float>();
  if (!is_whole(cursor)) return std::nullopt;
  return value;
}

std::optional<std::uint32_t> parse_uint32(Bytes bytes) {
  ByteCursor cursor(bytes);
  const auto value = cursor.read<std::uint32_t>();
  if (!is_whole(cursor)) return std::nullopt;
  return value;
}

std::optional<std::vector<StampedPose>> parse_poses(std::string_view type, Bytes bytes) {
  ByteCursor cursor(bytes);
  std::vector<StampedPose> poses;
  if (type == "tf2_msgs/TFMessage" || type == "tf/tfMessage") {
    const auto count = cursor.read<std::uint32_t>();
    for (std::uint32_t i = 0; i < count && cursor.is_good(); ++i)
      poses.push_back(read_stamped(cursor, true));
  } else if (type == "nav_msgs/Odometry") {
    poses.push_back(read_stamped(cursor, true));
    cursor.skip(kCovarianceBytes + kTwistBytes + kCovarianceBytes);
  } else if (type == "geometry_msgs/PoseStamped") {
    poses.push_back(read_stamped(cursor, false));
  } else if (type == "geometry_msgs/PoseWithCovarianceStamped") {
    poses.push_back(read_stamped(cursor, false));
    cursor.skip(kCovarianceBytes);
  } else if (type == "geometry_msgs/TransformStamped") {
    poses.push_back(read_stamped(cursor, true));
  } else {
    return std::nullopt;
  }
  if (!is_whole(cursor)) return std::nullopt;
  return poses;
}

}  // namespace swiftlet::ros
