// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/frame/depth_image.hpp"
#include "swiftlet/frame/intrinsics.hpp"

namespace swiftlet {

/// The space that the vehicle itself takes up [m, body]: arms, legs, propellers.
struct BodyBox {
  Eigen::Vector3d from_m;
  Eigen::Vector3d to_m;
};

/// Drops the readings of one camera that lie in the body box, so that a drone does not map itself.
/// Which depths of which pixels those are is worked out once: a frame costs no more than looking at
/// the pixels whose rays meet the box.
class BodyBoxMask {
 public:
  BodyBoxMask(const BodyBox& box, const Transform<Body, Camera>& T_body_camera,
              const PinholeIntrinsics& intrinsics);

  /// REQUIRES: an image of intrinsics().
  void clear(DepthImage& depth) const;

  [[nodiscard]] const PinholeIntrinsics& intrinsics() const { return intrinsics_; }

 private:
  /// Depths (z) between which the ray of a pixel is in the box.
  struct Stretch {
    std::uint32_t pixel;
    float from_m, to_m;
  };
  PinholeIntrinsics intrinsics_;
  std::vector<Stretch> stretches_;
};

}  // namespace swiftlet
