// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/scene.hpp"

namespace swiftlet::sim {

void make_ideal(StereoOptions& camera, TrackerOptions& tracker) {
  camera.is_ideal = true;
  tracker = {.rate_hz = tracker.rate_hz,
             .position_noise_m = 0.0,
             .attitude_noise_rad = 0.0,
             .drift_m_per_sqrt_s = 0.0,
             .yaw_drift_rad_per_sqrt_s = 0.0,
             .medium_after_s = 0.0,
             .high_after_s = 0.0,
             .jump = std::nullopt};
}

Transform<Body, Camera> mount_from(const Eigen::Vector3d& at_m,
                                   const Eigen::Quaterniond& R_body_flyer) {
  return Transform<Body, Body>::trusted(R_body_flyer, at_m) * forward_looking_camera();
}

Transform<Body, Camera> default_mount() {
  return mount_from({0.012, 0.018, 0.031},
                    rotation_from_ypr(radians(0.8), radians(2.5), radians(-0.5)));
}

}  // namespace swiftlet::sim
