// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/bag/depth_decoder.hpp"

#include <cmath>
#include <utility>

#include "swiftlet/source/bag/cloud_depth.hpp"
#include "swiftlet/source/bag/compressed_depth.hpp"
#include "swiftlet/source/bag/depth_message.hpp"

namespace swiftlet {
namespace {

constexpr std::string_view kImage = "sensor_msgs/Image";
constexpr std::string_view kCompressed = "sensor_msgs/CompressedImage";
constexpr std::string_view kCloud = "sensor_msgs/PointCloud2";

using Decoded = tl::expected<DecodedDepth, std::string>;

Decoded with_stamp(Stamp stamp, tl::expected<DepthImage, std::string>&& depth) {
  if (!depth) return tl::make_unexpected(std::move(depth).error());
  return DecodedDepth{stamp, std::move(*depth)};
}

ros::CameraInfo camera_of(const CloudDepth& cloud) {
  ros::CameraInfo camera;
  camera.width = static_cast<std::uint32_t>(cloud.depth.raw.width());
  camera.height = static_cast<std::uint32_t>(cloud.depth.raw.height());
  camera.K = {cloud.fx, 0.0, cloud.cx, 0.0, cloud.fy, cloud.cy, 0.0, 0.0, 1.0};
  return camera;
}

Decoded decode_image(const BagMessage& message, float unit_m) {
  const auto image = ros::parse_image(message.serialized());
  if (!image) return tl::make_unexpected("it is no image message");
  const float own_m = image->depth_unit_m.value_or(unit_m);
  const bool is_usable = std::isfinite(own_m) && own_m > 0.0F;
  return with_stamp(image->header.stamp, depth_from_message(*image, is_usable ? own_m : unit_m));
}

Decoded decode_cloud(const BagMessage& message, float unit_m) {
  const auto cloud = ros::parse_point_cloud(message.serialized());
  if (!cloud) return tl::make_unexpected("it is no PointCloud2");
  auto seen = depth_from_cloud(*cloud, unit_m);
  if (!seen) return tl::make_unexpected(std::move(seen).error());
  DecodedDepth decoded{cloud->header.stamp, {}};
  if (seen->fx > 0.0 && seen->fy > 0.0) decoded.camera = camera_of(*seen);
  decoded.depth = std::move(seen->depth);
  return decoded;
}

}  // namespace

bool is_depth_type(std::string_view type) {
  return type == kImage || type == kCompressed || type == kCloud;
}

std::optional<DepthHead> depth_head(const BagMessage& message) {
  const std::string& type = message.connection->type;
  if (type == kImage) {
    const auto image = ros::parse_image(message.serialized());
    if (!image) return std::nullopt;
    return DepthHead{may_be_depth(image->encoding) ? image->encoding : std::string_view{},
                     image->header.frame_id, image->width, image->height};
  }
  if (type == kCompressed) {
    const auto image = ros::parse_compressed_image(message.serialized());
    if (!image) return std::nullopt;
    return DepthHead{encoding_of_compressed(*image), image->header.frame_id};
  }
  if (type != kCloud) return std::nullopt;
  const auto cloud = ros::parse_point_cloud(message.serialized());
  if (!cloud) return std::nullopt;
  return DepthHead{cloud->height > 1 ? "organised cloud" : "", cloud->header.frame_id, cloud->width,
                   cloud->height};
}

Decoded decode_depth(const BagMessage& message, float unit_m) {
  if (message.connection->type == kImage) return decode_image(message, unit_m);
  if (message.connection->type == kCloud) return decode_cloud(message, unit_m);
  const auto image = ros::parse_compressed_image(message.serialized());
  if (!image) return tl::make_unexpected("it is no image message");
  return with_stamp(image->header.stamp, depth_from_compressed(*image, unit_m));
}

std::string camera_info_beside(std::string_view topic) {
  // image_transport puts its ways of packing below the topic of the images.
  for (const std::string_view way : {"/compressedDepth", "/compressed"}) {
    if (topic.ends_with(way)) topic.remove_suffix(way.size());
  }
  return std::string(topic.substr(0, topic.rfind('/'))) + "/camera_info";
}

}  // namespace swiftlet
