// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/preprocess/depth_step.hpp"

namespace swiftlet::eval {

/// Calls visit(p) with the point [m, world] of every reading within range, row by row.
template <class Visit>
void for_each_point(const Frame& frame, const PreprocessOptions& range, Visit&& visit) {
  const DepthImage& depth = frame.depth;
  const PinholeIntrinsics& intrinsics = frame.intrinsics;
  const Eigen::Matrix3f R = frame.T_world_camera.rotation().toRotationMatrix().cast<float>();
  const Eigen::Vector3f origin = frame.T_world_camera.translation().cast<float>();
  const Eigen::Vector3f per_column = R * intrinsics.back_project(1.0, 0.0, 1.0).cast<float>() -
                                     R * intrinsics.back_project(0.0, 0.0, 1.0).cast<float>();
  const auto nearest_m = static_cast<float>(range.min_range_m);
  const auto farthest_m = static_cast<float>(range.max_range_m);
  for (int v = 0; v < depth.raw.height(); ++v) {
    const Eigen::Vector3f first = R * intrinsics.back_project(0.0, v, 1.0).cast<float>();
    for (int u = 0; u < depth.raw.width(); ++u) {
      const float z_m = depth.depth_m(u, v);  // 0 without a reading
      if (z_m == 0.0F || z_m < nearest_m || z_m > farthest_m) continue;
      visit(Eigen::Vector3f(origin + z_m * (first + static_cast<float>(u) * per_column)));
    }
  }
}

}  // namespace swiftlet::eval
