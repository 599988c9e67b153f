// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>

#include "swiftlet/bag/ros_messages.hpp"
#include "swiftlet/base/expected.hpp"
#include "swiftlet/frame/depth_image.hpp"

namespace swiftlet {

/// Depth from an organised cloud: the pinhole camera that its points are seen through, found from
/// them, and their z as an image.
struct CloudDepth {
  DepthImage depth;
  double fx = 0.0, fy = 0.0, cx = 0.0, cy = 0.0;  ///< [px]; all 0 with too few points to tell
};

/// Errors, in words: a cloud without rows, without x, y and z as floats, or whose points are not
/// seen through their pixels (another frame than the optical one, or moved there from another
/// camera). Cost: O(pixels).
[[nodiscard]] tl::expected<CloudDepth, std::string> depth_from_cloud(const ros::PointCloud& cloud,
                                                                     float unit_m);

}  // namespace swiftlet
