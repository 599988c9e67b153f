// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>

namespace swiftlet::eval {

/// A way that light took: what a camera sees along one pixel.
struct SightLine {
  Eigen::Vector3f eye_m;    ///< of the camera [world]
  Eigen::Vector3f point_m;  ///< the first surface on the way [world]
};

}  // namespace swiftlet::eval
