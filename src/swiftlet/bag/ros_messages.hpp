// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "swiftlet/base/time.hpp"

// The ROS 1 messages that a mapper needs, read from their serialised form: little-endian, no
// padding, strings and lists behind four bytes of length. Each parser returns nullopt unless the
// bytes are exactly one such message. Views point into the bytes.

namespace swiftlet::ros {

struct Header {
  std::uint32_t seq = 0;
  Stamp stamp;
  std::string_view frame_id;
};

/// sensor_msgs/Image.
struct Image {
  Header header;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string_view encoding;
  bool is_big_endian = false;
  std::uint32_t step = 0;  ///< bytes a row
  std::span<const std::byte> data;
  /// RealSense SDK 2.49 and later write it behind the message, without another type name.
  std::optional<float> depth_unit_m;
};

/// The part of a sensor that an image shows [px]; all 0: the whole.
struct Region {
  std::uint32_t x = 0, y = 0, height = 0, width = 0;
  friend bool operator==(const Region&, const Region&) = default;
};

/// sensor_msgs/CameraInfo, without R and P.
struct CameraInfo {
  Header header;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::string_view distortion_model;
  std::vector<double> D;
  std::array<double, 9> K{};
  std::uint32_t binning_x = 0, binning_y = 0;  ///< pixels of the sensor a pixel; 0 as 1
  Region region{};

  /// Whether all but the header is the same.
  [[nodiscard]] bool is_same_camera(const CameraInfo& other) const {
    return width == other.width && height == other.height && D == other.D && K == other.K &&
           binning_x == other.binning_x && binning_y == other.binning_y && region == other.region;
  }
};

/// geometry_msgs/Pose and Transform, which are stored alike.
struct Pose {
  Eigen::Vector3d t_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
};

/// A pose with its time and the frames that it ties: child in parent.
struct StampedPose {
  Stamp stamp;
  std::string parent;
  std::string child;  ///< empty where the type does not tell
  Pose pose;
};

struct KeyValue {
  std::string_view key;
  std::string_view value;
};

using Bytes = std::span<const std::byte>;

[[nodiscard]] std::optional<Image> parse_image(Bytes bytes);
[[nodiscard]] std::optional<CameraInfo> parse_camera_info(Bytes bytes);
[[nodiscard]] std::optional<Pose> parse_transform(Bytes bytes);
[[nodiscard]] std::optional<KeyValue> parse_key_value(Bytes bytes);
[[nodiscard]] std::optional<float> parse_float32(Bytes bytes);
[[nodiscard]] std::optional<std::uint32_t> parse_uint32(Bytes bytes);

/// The poses of a message of one of kPoseTypes; a tf message may hold many, the others hold one.
[[nodiscard]] std::optional<std::vector<StampedPose>> parse_poses(std::string_view type,
                                                                  Bytes bytes);
inline constexpr std::array<std::string_view, 6> kPoseTypes{
    "nav_msgs/Odometry",
    "geometry_msgs/PoseStamped",
    "geometry_msgs/PoseWithCovarianceStamped",
    "geometry_msgs/TransformStamped",
    "tf2_msgs/TFMessage",
    "tf/tfMessage"};

}  // namespace swiftlet::ros
