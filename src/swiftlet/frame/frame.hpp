// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/base/time.hpp"
#include "swiftlet/frame/depth_image.hpp"
#include "swiftlet/frame/intrinsics.hpp"

namespace swiftlet {

/// A moment on this computer's clock.
using HostTime = std::chrono::steady_clock::time_point;

/// What a depth camera saw, before anyone knows from where.
struct DepthFrame {
  Stamp stamp;                                    ///< of the middle of the exposure
  DepthImage depth;                               ///< as it was delivered
  PinholeIntrinsics intrinsics;                   ///< of this image
  std::uint8_t camera = 0;                        ///< which one of the rig
  ClockDomain clock = ClockDomain::kUnspecified;  ///< whose clock the stamp was read from
  std::optional<HostTime> seen_at{};              ///< as in Frame
};

/// A depth image with the pose of the camera at its time: all that the mapper needs.
struct Frame {
  Stamp stamp;                              ///< when the image was exposed
  DepthImage depth;                         ///< as it was delivered
  PinholeIntrinsics intrinsics;             ///< of this image
  Transform<World, Camera> T_world_camera;  ///< where the camera was
  std::uint8_t camera = 0;                  ///< which one of the rig
  /// Frames of different epochs share no world: after the pose source has lost its place, whoever
  /// maps must start again.
  std::uint32_t pose_epoch = 0;
  double baseline_m = 0.0;  ///< of this camera's stereo pair; 0: as the mapper is configured
  /// When it came from the camera, or is played as if it did; nullopt: nobody waits for it. How old
  /// the map is that holds it is counted from here.
  std::optional<HostTime> seen_at{};
};

}  // namespace swiftlet
