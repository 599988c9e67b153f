// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/depth_image.hpp"
#include "swiftlet/frame/intrinsics.hpp"

namespace swiftlet {

/// Whether an encoding of sensor_msgs/Image may be depth: 16UC1 and mono16 (device units), 32FC1
/// (metres).
[[nodiscard]] bool may_be_depth(std::string_view encoding);

/// Unpacks a depth image. `unit_m` is that of the 16-bit encodings; metres become steps of
/// `unit_m`, and what is not finite or beyond 65535 of them no reading. Errors: what is wrong, in
/// words.
[[nodiscard]] tl::expected<DepthImage, std::string> depth_from_message(const ros::Image& image,
                                                                       float unit_m);

/// Errors: kCorruptInput if K is impossible; kUnsupported if the images have lens distortion.
[[nodiscard]] Expected<PinholeIntrinsics> intrinsics_from_message(const ros::CameraInfo& info,
                                                                  const std::string& where);

}  // namespace swiftlet
