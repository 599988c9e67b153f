// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "swiftlet/base/time.hpp"

// The messages of ROS 2 that we write, as CDR. Their definitions: message_definitions.hpp.

namespace swiftlet::ros2 {

using Bytes = std::vector<std::uint8_t>;

/// When, and in which frame.
struct Header {
  Stamp stamp;
  std::string_view frame_id;
};

/// Where a child is in the frame of a header.
struct Placement {
  Eigen::Vector3d t_m = Eigen::Vector3d::Zero();
  Eigen::Quaterniond R = Eigen::Quaterniond::Identity();
};

/// sensor_msgs/Image of 16UC1: shape (height, width), millimetres, 0 for no reading.
[[nodiscard]] Bytes depth_image(const Header& header, std::uint32_t width, std::uint32_t height,
                                std::span<const std::uint16_t> depth_mm);
/// The same of 32FC1: metres, NaN for no reading.
[[nodiscard]] Bytes depth_image(const Header& header, std::uint32_t width, std::uint32_t height,
                                std::span<const float> depth_m);

/// sensor_msgs/CameraInfo of a camera without distortion.
[[nodiscard]] Bytes camera_info(const Header& header, std::uint32_t width, std::uint32_t height,
                                double fx, double fy, double cx, double cy);

/// tf2_msgs/TFMessage of one transform: the child in the frame of the header.
[[nodiscard]] Bytes transform(const Header& header, std::string_view child,
                              const Placement& placement);
/// nav_msgs/Odometry without velocities and covariances.
[[nodiscard]] Bytes odometry(const Header& header, std::string_view child,
                             const Placement& placement);
/// nav_msgs/Path.
[[nodiscard]] Bytes path(const Header& header, std::span<const Placement> poses);

/// sensor_msgs/PointCloud2 of voxels: x, y, z [m] and one byte, which `value_name` names.
class VoxelCloud {
 public:
  /// Far from the origin floats do not tell voxels apart, and points take 25 bytes instead of 13.
  VoxelCloud(std::string_view value_name, bool is_double)
      : value_name_(value_name), is_double_(is_double) {}
  void add(const Eigen::Vector3d& p, std::uint8_t value);
  [[nodiscard]] Bytes message(const Header& header) const;
  [[nodiscard]] bool is_empty() const { return points_.empty(); }

 private:
  [[nodiscard]] std::uint32_t number_bytes() const { return is_double_ ? 8 : 4; }

  std::string_view value_name_;
  bool is_double_;
  Bytes points_;
};

}  // namespace swiftlet::ros2
