// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <librealsense2/hpp/rs_internal.hpp>
#include <librealsense2/rs.hpp>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/frame/frame.hpp"
#include "swiftlet/source/rig/mounts.hpp"

// The scene of the driver's tests: Intel's bracket flies a straight line while it turns, before a
// wall 2 m ahead, as in the wall recording of the bag tests.

namespace swiftlet::test {

constexpr double kT0_ms = 1'600'000'100'000.0;
constexpr int kWidth = 424, kHeight = 240;
/// The rounding of depth, half a millimetre, and float poses.
constexpr double kWallTolerance_m = 0.00052;

/// What the T265 says.
inline rs2_pose pose_at(double t_ms) {
  const double s = 1e-3 * (t_ms - kT0_ms);
  rs2_pose pose{};
  pose.translation = {static_cast<float>(0.2 * s), static_cast<float>(0.05 * s),
                      static_cast<float>(-0.1 * s)};
  pose.rotation = {0.0F, static_cast<float>(std::sin(0.15 * s)), 0.0F,
                   static_cast<float>(std::cos(0.15 * s))};
  pose.tracker_confidence = 3;
  return pose;
}

/// The same where it truly is, in our axes: x = -z, y = -x, z = y of the T265.
inline Transform<World, Body> body_at(double t_ms) {
  const double s = 1e-3 * (t_ms - kT0_ms);
  return Transform<World, Body>::trusted(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.3 * s, Eigen::Vector3d::UnitZ())),
      {0.1 * s, -0.2 * s, 0.05 * s});
}

/// What a depth camera with a mount sees of the wall at a time [mm].
inline std::vector<std::uint16_t> wall_seen_at(
    double t_ms, const PinholeIntrinsics& K,
    const Transform<Body, Camera>& T_body_camera = intel_t265_d435_mount()) {
  const auto T = body_at(t_ms) * T_body_camera;
  std::vector<std::uint16_t> depth_mm;
  for (int v = 0; v < K.height(); ++v) {
    for (int u = 0; u < K.width(); ++u) {
      const Eigen::Vector3d ray = T.rotation() * K.back_project(u, v, 1.0);
      const double z_m = (2.0 - T.translation().x()) / ray.x();
      depth_mm.push_back(z_m > 0.0 && z_m < 10.0
                             ? static_cast<std::uint16_t>(std::lround(1e3 * z_m))
                             : std::uint16_t{0});
    }
  }
  return depth_mm;
}

/// How much deeper or less deep than the wall the worst pixel of a frame is.
inline double worst_off_the_wall_m(const Frame& frame) {
  double worst_m = 0.0;
  for (int v = 0; v < frame.intrinsics.height(); ++v) {
    for (int u = 0; u < frame.intrinsics.width(); ++u) {
      const float z_m = frame.depth.depth_m(u, v);
      if (z_m == 0.0F) continue;
      const auto& T = frame.T_world_camera;
      const Eigen::Vector3d ray = T.rotation() * frame.intrinsics.back_project(u, v, 1.0);
      worst_m = std::max(worst_m, std::abs(z_m - (2.0 - T.translation().x()) / ray.x()));
    }
  }
  return worst_m;
}

/// The SDK's software device with a D435's depth sensor.
class SoftwareCamera {
 public:
  SoftwareCamera() : sensor_(device_.add_sensor("Stereo Module")) {
    rs2_intrinsics K{
        kWidth,         kHeight, 211.6F, 120.4F, 212.75F, 212.625F, RS2_DISTORTION_BROWN_CONRADY,
        {0, 0, 0, 0, 0}};
    profile_ = sensor_.add_video_stream(
        {RS2_STREAM_DEPTH, 0, 0, kWidth, kHeight, 30, 2, RS2_FORMAT_Z16, K});
    sensor_.add_read_only_option(RS2_OPTION_DEPTH_UNITS, 0.001F);
    sensor_.add_read_only_option(RS2_OPTION_STEREO_BASELINE, 50.0F);
  }
  [[nodiscard]] const rs2::device& device() const { return device_; }
  [[nodiscard]] static PinholeIntrinsics intrinsics() {
    return PinholeIntrinsics::create(kWidth, kHeight, 212.75, 212.625, 211.6F, 120.4F).value();
  }

  void deliver(const std::vector<std::uint16_t>& pixels, double t_ms, int number) {
    auto* const copy = new std::uint16_t[pixels.size()];  // the SDK's from now on
    std::memcpy(copy, pixels.data(), pixels.size() * sizeof *copy);
    sensor_.on_video_frame({copy, [](void* p) { delete[] static_cast<std::uint16_t*>(p); },
                            2 * kWidth, 2, t_ms, RS2_TIMESTAMP_DOMAIN_SYSTEM_TIME, number,
                            profile_.get()});
  }

 private:
  rs2::software_device device_;
  rs2::software_sensor sensor_;
  rs2::stream_profile profile_;
};

}  // namespace swiftlet::test
