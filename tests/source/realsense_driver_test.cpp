// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The driver against the real SDK's software device: depth through the SDK, poses through the entry
// that the T265's callback uses. No camera is needed.

#if SWIFTLET_HAS_REALSENSE

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "source/software_camera.hpp"
#include "swiftlet/source/live/live_rig.hpp"
#include "swiftlet/source/realsense/realsense_driver_private.hpp"
#include "swiftlet/source/rig/rig_file.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet {
namespace {

using ::testing::HasSubstr;
using namespace test;

constexpr int kFrames = 8;

LiveRig new_rig(Nanoseconds timeout = std::chrono::seconds(10)) {
  return {SourceInfo{"realsense:test", "+y", std::nullopt, std::nullopt},
          {.rig = intel_t265_d435_rig().rig, .queue = {.capacity = 100}, .timeout = timeout}};
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
    const auto deliver = [&](int k) {
      const double t_ms = kT0_ms + 12.3 + k * 1000.0 / 30.0;
      camera.deliver(wall_seen_at(t_ms, depth->info.intrinsics), t_ms, k + 1);
    };
    deliver(0);  // believed when the next one agrees with its time
    for (int k = 1; k <= kFrames; ++k) {
      if (k < kFrames) deliver(k);
      const auto frame = rig.next();
      ASSERT_TRUE(frame && *frame);
      EXPECT_LT(worst_off_the_wall_m(**frame), kWallTolerance_m);
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
  for (const int k : {0, 1}) {  // two that agree begin a stream
    const double t_ms = kT0_ms + 33.3 * k;
    take_pose(pose_at(t_ms), t_ms, RS2_TIMESTAMP_DOMAIN_HARDWARE_CLOCK, rig);
    camera.deliver(wall_seen_at(t_ms, depth->info.intrinsics), t_ms, k + 1);
  }
  EXPECT_FALSE(rig.next()) << "no image that fits, then silence";
  FrameTally tally = rig.tally();
  EXPECT_EQ(tally.of(FrameLoss::kClockMismatch), 2U);
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
