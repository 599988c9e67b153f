// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Any bytes are a message of ROS 1 or ROS 2 (the first byte says of which type and encoding):
// images, what compressedDepth packs, clouds, cameras and poses.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "swiftlet/bag/bag_message.hpp"
#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/source/bag/depth_decoder.hpp"
#include "swiftlet/source/bag/depth_message.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace swiftlet;
  constexpr std::array<std::string_view, 4> kTypes{
      "sensor_msgs/Image", "sensor_msgs/CompressedImage", "sensor_msgs/PointCloud2",
      "sensor_msgs/CameraInfo"};
  if (size == 0) return 0;
  const std::size_t choice = data[0] / 2U;
  BagConnection connection;
  connection.encoding = data[0] % 2 == 0 ? MessageEncoding::kCdr : MessageEncoding::kRos1;
  connection.type =
      choice < kTypes.size() ? kTypes[choice] : ros::kPoseTypes[choice % ros::kPoseTypes.size()];
  const BagMessage message{&connection, {}, std::as_bytes(std::span(data, size)).subspan(1), 0};
  (void)ros::parse_frames(connection.type, message.serialized());
  (void)ros::parse_poses(connection.type, message.serialized());
  (void)depth_head(message);
  if (is_depth_type(connection.type)) (void)decode_depth(message, 0.001F);
  const auto info = ros::parse_camera_info(message.serialized());
  if (info) (void)intrinsics_of_images(*info, 640, 480, "");
  return 0;
}
