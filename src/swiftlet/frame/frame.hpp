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
  Stamp stamp;  ///< of the middle of the exposure
  DepthImage depth;
  PinholeIntrinsics intrinsics;
  std::uint8_t camera = 0;  ///< which one of the rig
  ClockDomain clock = ClockDomain::kUnspecified;
};

/// A depth image with the pose of the camera at its time: all that the mapper needs.
struct Frame {
  Stamp stamp;
  DepthImage depth;
  PinholeIntrinsics intrinsics;
  Transform<World, Camera> T_world_camera;
  std::uint8_t camera = 0;  ///< which one of the rig
  /// Frames of different epochs share no world: after the pose source has lost its place, whoever
  /// maps must start again.
  std::uint32_t pose_epoch = 0;
  double baseline_m = 0.0;  ///< of this camera's stereo pair; 0: as the mapper is configured
};

}  // namespace swiftlet
