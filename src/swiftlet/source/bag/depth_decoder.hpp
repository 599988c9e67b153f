// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "swiftlet/bag/bag_message.hpp"
#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/frame/depth_image.hpp"

namespace swiftlet {

/// Depth out of a message, whatever type of message carried it.
struct DecodedDepth {
  Stamp stamp;
  DepthImage depth;
  std::optional<ros::CameraInfo> camera{};  ///< where the message itself tells, as a cloud does
};

/// Types of messages that may hold depth: sensor_msgs/Image, CompressedImage, PointCloud2.
[[nodiscard]] bool is_depth_type(std::string_view type);

/// What is known of the depth in a message before it is unpacked. Views point into the message.
struct DepthHead {
  std::string_view encoding;  ///< of the pixels, as in "16UC1"; empty: it is no depth
  std::string_view frame_id;
  std::uint32_t width = 0, height = 0;  ///< [px]; 0 where only unpacking tells
};
/// nullopt if it is no message of one of these types.
[[nodiscard]] std::optional<DepthHead> depth_head(const BagMessage& message);

/// Unpacks it. `unit_m` is the step of 16-bit images; an image that tells its own comes in that.
/// Errors: what is wrong, in words.
[[nodiscard]] tl::expected<DecodedDepth, std::string> decode_depth(const BagMessage& message,
                                                                   float unit_m);

/// The topic of the CameraInfo that belongs to a topic of images by ROS's convention: camera_info
/// beside it.
[[nodiscard]] std::string camera_info_beside(std::string_view topic);

}  // namespace swiftlet
