// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/rig/rig.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

Stamp ms(std::int64_t value) { return Stamp{} + milliseconds(value); }

PoseSample pose_at(std::int64_t t_ms, std::uint8_t confidence = 3) {
  return {ms(t_ms),
          Eigen::Quaterniond::Identity(),
          {static_cast<double>(t_ms) * 1e-3, 0, 0},
          confidence};
}
DepthFrame depth_at(std::int64_t t_ms) {
  return {ms(t_ms), DepthImage{}, PinholeIntrinsics::create(4, 4, 4, 4, 2, 2).value()};
}
std::size_t lost(const Rig& rig, FrameLoss loss) {
  FrameTally tally = rig.tally();
  return tally.of(loss);
}

TEST(Rig, gives_a_depth_image_the_pose_of_its_own_time_and_the_mount) {
  test::for_each_seed(50, [](test::Random& random) {
    const auto R = random.rotation();
    const auto mount = Transform<Body, Camera>::from(R, random.vector(-0.2, 0.2)).value();
    Rig rig({.cameras = {{.T_body_camera = mount}}});
    rig.push(pose_at(0));
    rig.push(depth_at(4));
    EXPECT_FALSE(rig.pop()) << "the pose after it has not come";
    rig.push(pose_at(10));
    const auto frame = rig.pop();
    ASSERT_TRUE(frame);
    EXPECT_EQ(frame->stamp, ms(4));
    const Eigen::Vector3d expected = Eigen::Vector3d(0.004, 0, 0) + mount.translation();
    EXPECT_LT((frame->T_world_camera.translation() - expected).norm(), 1e-12);
    EXPECT_LT(frame->T_world_camera.rotation().angularDistance(mount.rotation()), 1e-7);
  });
}

TEST(Rig, waits_for_late_poses_and_then_delivers_in_order) {
  Rig rig({});
  for (const int t : {10, 20, 30}) rig.push(depth_at(t));
  EXPECT_FALSE(rig.pop());
  rig.push(pose_at(5));
  EXPECT_FALSE(rig.pop());
  rig.push(pose_at(25));
  EXPECT_EQ(rig.pop()->stamp, ms(10));
  EXPECT_EQ(rig.pop()->stamp, ms(20));
  EXPECT_FALSE(rig.pop()) << "30 is after the last pose";
  rig.push(pose_at(30));
  EXPECT_EQ(rig.pop()->stamp, ms(30));
  EXPECT_EQ(rig.tally().delivered, 3U);
}

TEST(Rig, lets_only_so_many_depth_images_wait_and_loses_the_oldest) {
  Rig rig({.max_waiting = 3});
  for (int t = 0; t < 10; ++t) rig.push(depth_at(t));
  EXPECT_EQ(lost(rig, FrameLoss::kNoPose), 7U);
  rig.push(pose_at(0));
  rig.push(pose_at(20));
  EXPECT_EQ(rig.pop()->stamp, ms(7));
}

TEST(Rig, decides_at_the_end_what_still_waits) {
  Rig rig({});
  rig.push(pose_at(0));
  rig.push(pose_at(10));
  rig.push(depth_at(10));
  rig.push(depth_at(11));
  EXPECT_EQ(rig.pop()->stamp, ms(10));
  EXPECT_FALSE(rig.pop());
  EXPECT_EQ(lost(rig, FrameLoss::kNoPose), 0U) << "its pose may still come";
  rig.finish();
  EXPECT_FALSE(rig.pop());
  EXPECT_EQ(lost(rig, FrameLoss::kNoPose), 1U);
}

TEST(Rig, raises_no_alarm_for_a_clock_that_is_set_ahead_but_for_a_tracker_that_does_not_follow) {
  constexpr std::int64_t kHour_ms = 3'600'000;
  for (const bool is_silent : {false, true}) {
    Rig rig({});
    for (int t = 0; t < 1000; t += 33) {
      rig.push(pose_at(t));
      rig.push(depth_at(t));
    }
    for (int t = 1000; t < 3000; t += 33) {
      rig.push(depth_at(kHour_ms + t));  // images see the new time first
      if (!is_silent) rig.push(pose_at(kHour_ms + t));
      while (rig.pop()) {
      }
    }
    EXPECT_EQ(rig.tally().stale_alarms, is_silent ? 1U : 0U);
  }
}

TEST(Rig, raises_the_alarm_also_for_a_camera_of_one_image_in_two_seconds) {
  Rig rig({});
  rig.push(pose_at(0));
  rig.push(pose_at(100));
  for (int t = 0; t <= 4000; t += 2000) rig.push(depth_at(t));
  EXPECT_EQ(rig.tally().stale_alarms, 1U);
}

TEST(Rig, loses_images_before_the_first_pose_and_in_gaps_by_their_reasons) {
  Rig rig({.poses = {.track = {.max_gap = milliseconds(100)}, .gates = {}}});
  rig.push(depth_at(0));
  rig.push(depth_at(50));
  rig.push(depth_at(200));
  rig.push(depth_at(320));
  for (const int t : {40, 60, 300, 340}) rig.push(pose_at(t));
  EXPECT_EQ(rig.pop()->stamp, ms(50));
  EXPECT_EQ(rig.pop()->stamp, ms(320));
  EXPECT_EQ(lost(rig, FrameLoss::kNoPose), 1U);
  EXPECT_EQ(lost(rig, FrameLoss::kPoseGap), 1U);
}

TEST(Rig, refuses_poses_the_tracker_does_not_trust_and_broken_ones) {
  Rig rig({.poses = {.track = {}, .gates = {.min_confidence = 2}}});
  rig.push(pose_at(0, 1));
  PoseSample broken = pose_at(1);
  broken.t_world_body_m.y() = std::numeric_limits<double>::quiet_NaN();
  rig.push(broken);
  rig.push(pose_at(2, 2));
  rig.push(pose_at(2, 3));
  EXPECT_EQ(rig.tally().poses_refused, 3U) << "untrusted, NaN, and the second of one time";
  rig.push(depth_at(1));
  rig.push(pose_at(10));
  EXPECT_FALSE(rig.pop()) << "no trusted pose at or before it";
  EXPECT_EQ(lost(rig, FrameLoss::kNoPose), 1U);
}

TEST(Rig, never_delivers_two_images_of_one_time_nor_goes_back) {
  Rig rig({});
  for (const int t : {0, 100}) rig.push(pose_at(t));
  for (const int t : {10, 30, 30, 20, 40}) rig.push(depth_at(t));
  for (const int t : {10, 30, 40}) EXPECT_EQ(rig.pop()->stamp, ms(t));
  EXPECT_FALSE(rig.pop());
  EXPECT_EQ(lost(rig, FrameLoss::kOutOfOrder), 2U);
}

}  // namespace
}  // namespace swiftlet
