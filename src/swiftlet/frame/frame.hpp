// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/frame/depth_image.hpp"
#include "swiftlet/frame/intrinsics.hpp"

namespace swiftlet {

/// What a depth camera saw, before anyone knows from where.
struct DepthFrame {
  Stamp stamp;
  DepthImage depth;
  PinholeIntrinsics intrinsics;
};

/// A depth image with the pose of the camera at its time: all that the mapper needs.
struct Frame {
  Stamp stamp;
  DepthImage depth;
  PinholeIntrinsics intrinsics;
  Transform<World, Camera> T_world_camera;
};

}  // namespace swiftlet
