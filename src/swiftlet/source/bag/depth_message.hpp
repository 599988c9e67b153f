// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
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

/// Metres as steps of `unit_m`, as above.
[[nodiscard]] std::uint16_t steps_of(float depth_m, float unit_m);

/// Share of neighbours in a row, of those with a reading both, that differ by less than 5 %: high
/// for depth, low for what a lamp and noise draw. nullopt with too few to tell.
[[nodiscard]] std::optional<double> smooth_share(const DepthImage& depth);

/// What a CameraInfo says of images of that size: its K moved and scaled by its region and binning,
/// if these make the size of its sensor that of the images. Where the size was adapted and K was
/// not, the principal point tells.
/// Errors: kCorruptInput if the size does not fit; those of intrinsics_from_message().
[[nodiscard]] Expected<PinholeIntrinsics> intrinsics_of_images(const ros::CameraInfo& info,
                                                               int width, int height,
                                                               const std::string& where);

/// Errors: kCorruptInput if K is impossible; kUnsupported if the images have lens distortion.
[[nodiscard]] Expected<PinholeIntrinsics> intrinsics_from_message(const ros::CameraInfo& info,
                                                                  const std::string& where);

}  // namespace swiftlet
