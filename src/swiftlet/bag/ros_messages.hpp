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

#include "swiftlet/bag/messages/serialized_message.hpp"
#include "swiftlet/base/time.hpp"

// The messages of ROS that a mapper needs, whichever ROS has serialised them. Each parser returns
// nullopt unless the bytes are exactly one such message. Views point into the bytes.

namespace swiftlet::ros {

struct Header {
  std::uint32_t seq = 0;  ///< 0 in ROS 2, which has none
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

/// sensor_msgs/CompressedImage.
struct CompressedImage {
  Header header;
  std::string_view format;  ///< as in "16UC1; compressedDepth png"
  std::span<const std::byte> data;
};

/// sensor_msgs/PointField.
struct PointField {
  static constexpr std::uint8_t kFloat32 = 7;
  std::string_view name;
  std::uint32_t offset = 0;  ///< in a point [bytes]
  std::uint8_t datatype = 0;
  std::uint32_t count = 0;
};

/// sensor_msgs/PointCloud2.
struct PointCloud {
  Header header;
  std::uint32_t width = 0;
  std::uint32_t height = 0;  ///< above 1: organised as an image
  std::vector<PointField> fields;
  bool is_big_endian = false;
  std::uint32_t point_step = 0;  ///< bytes a point
  std::uint32_t row_step = 0;
  std::span<const std::byte> data;
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

[[nodiscard]] std::optional<Image> parse_image(const SerializedMessage& message);
[[nodiscard]] std::optional<CompressedImage> parse_compressed_image(
    const SerializedMessage& message);
[[nodiscard]] std::optional<PointCloud> parse_point_cloud(const SerializedMessage& message);
[[nodiscard]] std::optional<CameraInfo> parse_camera_info(const SerializedMessage& message);
[[nodiscard]] std::optional<Pose> parse_transform(const SerializedMessage& message);
[[nodiscard]] std::optional<KeyValue> parse_key_value(const SerializedMessage& message);
[[nodiscard]] std::optional<float> parse_float32(const SerializedMessage& message);
[[nodiscard]] std::optional<std::uint32_t> parse_uint32(const SerializedMessage& message);

/// The frames that a message names: of a type that begins with a header, its own; of tf, each
/// child. Empty for types that tell none, and for what is no such message.
[[nodiscard]] std::vector<std::string> parse_frames(std::string_view type,
                                                    const SerializedMessage& message);

/// The poses of a message of one of kPoseTypes; a tf message may hold many, the others hold one.
[[nodiscard]] std::optional<std::vector<StampedPose>> parse_poses(std::string_view type,
                                                                  const SerializedMessage& message);
inline constexpr std::array<std::string_view, 6> kPoseTypes{
    "nav_msgs/Odometry",
    "geometry_msgs/PoseStamped",
    "geometry_msgs/PoseWithCovarianceStamped",
    "geometry_msgs/TransformStamped",
    "tf2_msgs/TFMessage",
    "tf/tfMessage"};
[[nodiscard]] bool is_pose_type(std::string_view type);
/// Those of kPoseTypes that tie many frames together.
[[nodiscard]] bool is_tf_type(std::string_view type);

}  // namespace swiftlet::ros
