// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/image.hpp"
#include "swiftlet/frame/depth_image.hpp"

namespace swiftlet {

/// The encoding of the depth in a compressed image, as in "16UC1": what image_transport packs as
/// compressedDepth (PNG or RVL behind twelve bytes), and 16-bit PNGs, which the RealSense SDK and
/// image_transport's other way write. Empty if it is no depth.
[[nodiscard]] std::string_view encoding_of_compressed(const ros::CompressedImage& image);

/// Unpacks it as depth_from_message() does. Depth in metres was quantised by its inverse.
/// Errors: what is wrong, in words. Memory: what the bytes can hold, whatever they say.
/// Source: ros-perception/image_transport_plugins, compressed_depth_image_transport.
[[nodiscard]] tl::expected<DepthImage, std::string> depth_from_compressed(
    const ros::CompressedImage& image, float unit_m);

/// Unpacks an image of RVL. Errors: in words. Source: Wilson, Fast Lossless Depth Image
/// Compression, ISS 2017.
[[nodiscard]] tl::expected<Image<std::uint16_t>, std::string> decode_rvl(
    std::span<const std::byte> bytes);

}  // namespace swiftlet
