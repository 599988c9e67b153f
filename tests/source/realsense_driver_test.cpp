// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The driver against the real SDK's software device: depth through the SDK, poses through the entry
// that the T265's callback uses. No camera is needed.

#if SWIFTLET_HAS_REALSENSE

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <librealsense2/hpp/rs_internal.hpp>

#include "swiftlet/source/realsense_driver_private.hpp"
#include "swiftlet/source/rig_file.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet {
namespace {

using ::testing::HasSubstr;

constexpr double kT0_ms = 1'600'000'100'000.0;
constexpr int kWidth = 424, kHeight = 240, kFrames = 8;

/// The T265 flies a straight line while it turns, as in the wall recording of the tests.
rs2_pose pose_at(double t_ms) {
  const double s = 1e-3 * (t_ms - kT0_ms);
  rs2_pose pose{};
  pose.translation = {static_cast<float>(0.2 * s), static_cast<float>(0.05 * s),
                      static_cast<float>(-0.1 * s)};
  pose.rotation = {0.0F, static_cast<float>(std::sin(0.15 * s)), 0.0F,
                   static_cast<float>(std::cos(0.15 * s))};
  pose.tracker_confidence = 3;
  return pose;
}

/// A wall 2 m ahead of the start: what the depth camera on Intel's bracket sees of it at a time
/// [mm].
std::vector<std::uint16_t> wall_seen_at(double t_ms, const PinholeIntrinsics& K) {
  const double s = 1e-3 * (t_ms - kT0_ms);
  // In our axes: x = -z, y = -x, z = y of the T265.
  const auto T_world_body = Transform<World, Body>::trusted(
      Eigen::Quaterniond(Eigen::AngleAxisd(0.3 * s, Eigen::Vector3d::UnitZ())),
      {0.1 * s, -0.2 * s, 0.05 * s});
  const auto T = T_world_body * intel_t265_d435_mount();
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

/// A software device with a D435's depth sensor.
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

  void deliver(std::vector<std::uint16_t> pixels, double t_ms, int number) {
    images_.push_back(std::move(pixels));
    sensor_.on_video_frame({images_.back().data(), [](void*) {}, 2 * kWidth, 2, t_ms,
                            RS2_TIMESTAMP_DOMAIN_SYSTEM_TIME, number, profile_.get()});
  }

 private:
  rs2::software_device device_;
  rs2::software_sensor sensor_;
  rs2::stream_profile profile_;
  std::vector<std::vector<std::uint16_t>> images_;  // the SDK reads them later
};

LiveRig new_rig(Nanoseconds patience = std::chrono::seconds(10)) {
  return {SourceInfo{"realsense:test", "+y", std::nullopt, std::nullopt},
          {.rig = intel_t265_d435_rig().rig, .queue = {.capacity = 100}, .patience = patience}};
}

TEST(RealsenseDriver, puts_the_depth_of_the_sdk_on_the_wall_within_the_rounding_of_depth) {
  SoftwareCamera camera;
  const auto depth = prepare_depth(camera.device(), {.width = kWidth, .height = kHeight});
  ASSERT_TRUE(depth) << depth.error().text();
  EXPECT_EQ(depth->info.unit_m, 0.001F);
  EXPECT_NEAR(depth->info.baseline_m, 0.05, 1e-9);
  LiveRig rig = new_rig();
  {
    const auto stream = start_depth(*depth, 0, rig);
    ASSERT_TRUE(stream) << stream.error().text();
    for (int i = 0; i < 64; ++i) {
      const double t_ms = kT0_ms + 5.0 * i;
      take_pose(pose_at(t_ms), t_ms, RS2_TIMESTAMP_DOMAIN_SYSTEM_TIME, rig);
    }
    for (int k = 0; k < kFrames; ++k) {
      const double t_ms = kT0_ms + 12.3 + k * 1000.0 / 30.0;
      camera.deliver(wall_seen_at(t_ms, depth->info.intrinsics), t_ms, k + 1);
      const auto frame = rig.next();
      ASSERT_TRUE(frame && *frame);
      double worst_m = 0.0;
      for (int v = 0; v < kHeight; ++v) {
        for (int u = 0; u < kWidth; ++u) {
          const float z_m = (*frame)->depth.depth_m(u, v);
          if (z_m == 0.0F) continue;
          const Eigen::Vector3d p =
              (*frame)->T_world_camera * (*frame)->intrinsics.back_project(u, v, z_m);
          worst_m = std::max(worst_m, std::abs(p.x() - 2.0));
        }
      }
      EXPECT_LT(worst_m, 0.00056) << "half a millimetre of depth along a ray, and float poses";
    }
  }
  rig.close();
  EXPECT_EQ(rig.tally().delivered, static_cast<std::size_t>(kFrames));
}

TEST(RealsenseDriver, refuses_poses_of_another_clock_and_counts_the_frames) {
  SoftwareCamera camera;
  const auto depth = prepare_depth(camera.device(), {.width = kWidth, .height = kHeight});
  LiveRig rig = new_rig(std::chrono::milliseconds(200));
  const auto stream = start_depth(*depth, 0, rig);
  ASSERT_TRUE(stream);
  take_pose(pose_at(kT0_ms), kT0_ms, RS2_TIMESTAMP_DOMAIN_HARDWARE_CLOCK, rig);
  camera.deliver(wall_seen_at(kT0_ms, depth->info.intrinsics), kT0_ms, 1);
  EXPECT_FALSE(rig.next()) << "no image that fits, then silence";
  FrameTally tally = rig.tally();
  EXPECT_EQ(tally.of(FrameLoss::kClockMismatch), 1U);
}

TEST(RealsenseDriver, names_the_profiles_there_are) {
  SoftwareCamera camera;
  const auto depth = prepare_depth(camera.device(), {.width = 1280, .height = 720});
  ASSERT_FALSE(depth);
  EXPECT_THAT(depth.error().text(), HasSubstr("424x240@30"));
}

TEST(RealsenseDriver, survives_poses_that_are_no_numbers) {
  LiveRig rig = new_rig();
  rs2_pose pose = pose_at(kT0_ms);
  pose.translation.x = std::nanf("");
  take_pose(pose, kT0_ms, RS2_TIMESTAMP_DOMAIN_SYSTEM_TIME, rig);
  take_pose(pose_at(kT0_ms), std::nan(""), RS2_TIMESTAMP_DOMAIN_SYSTEM_TIME, rig);
  take_pose(pose_at(kT0_ms), 1e300, RS2_TIMESTAMP_DOMAIN_SYSTEM_TIME, rig);
  rig.close();
  EXPECT_TRUE(rig.next());
  EXPECT_EQ(rig.tally().poses_refused, 1U);
}

TEST(RealsenseSource, says_that_no_camera_is_connected) {
  const auto source = open_source("realsense:no-such-serial");
  ASSERT_FALSE(source);
  EXPECT_THAT(source.error().text(), HasSubstr("is connected"));
  EXPECT_THAT(open_source("realsense:?profile=big").error().text(), HasSubstr("WIDTHxHEIGHT@FPS"));
}

}  // namespace
}  // namespace swiftlet

#endif  // SWIFTLET_HAS_REALSENSE
