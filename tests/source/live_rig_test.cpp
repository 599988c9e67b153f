// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/live/live_rig.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

const SourceInfo kInfo{"live:", "+y", std::nullopt, std::nullopt};

Stamp ms(int value) { return Stamp{} + milliseconds(value); }
PoseSample pose_at(int t_ms) {
  return {ms(t_ms), Eigen::Quaterniond::Identity(), {1e-3 * t_ms, 0, 0}};
}
DepthFrame depth_at(int t_ms) {
  return {ms(t_ms), DepthImage{}, PinholeIntrinsics::create(4, 4, 4, 4, 2, 2).value()};
}

TEST(LiveRig, joins_what_two_drivers_deliver_from_threads_of_their_own) {
  LiveRig rig(kInfo, {.rig = {}, .queue = {.capacity = 1000}});
  std::thread tracker([&] {
    for (int t = 0; t <= 2000; t += 5) rig.push(pose_at(t));
  });
  tracker.join();  // its poses are remembered, whenever the images come
  std::thread camera([&] {
    for (int t = 0; t < 2000; t += 33) rig.push(depth_at(t));
    rig.close();
  });
  int frames = 0;
  while (true) {
    const auto frame = rig.next();
    ASSERT_TRUE(frame);
    if (!*frame) break;
    EXPECT_EQ((*frame)->stamp, ms(33 * frames));
    EXPECT_NEAR((*frame)->T_world_camera.translation().x(), 0.033 * frames, 1e-9);
    ++frames;
  }
  camera.join();
  EXPECT_EQ(frames, 61);
  EXPECT_EQ(rig.tally().delivered, 61U);
}

TEST(LiveRig, never_makes_a_driver_wait_and_counts_what_the_mapper_was_too_late_for) {
  LiveRig rig(kInfo, {.rig = {}, .queue = {.capacity = 2}});
  for (int t = 0; t <= 330; t += 5) {
    rig.push(pose_at(t));
    if (t % 33 == 0) rig.push(depth_at(t));
  }
  rig.close();
  std::vector<Stamp> stamps;
  while (auto frame = rig.next().value()) stamps.push_back(frame->stamp);
  EXPECT_EQ(stamps, (std::vector{ms(165), ms(330)}));
  FrameTally tally = rig.tally();
  EXPECT_EQ(tally.of(FrameLoss::kOverload), 1U);
}

TEST(LiveRig, is_not_blinded_by_one_stamp_an_hour_ahead_nor_by_a_clock_that_is_set_back) {
  LiveRig rig(kInfo, {.rig = {}, .queue = {.capacity = 1000}});
  const auto fly = [&](int from_ms, int to_ms, int clock_ms) {
    for (int t = from_ms; t < to_ms; t += 5) {
      PoseSample pose = pose_at(t);
      pose.stamp = ms(t + clock_ms);
      rig.push(pose);
      if (t % 35 == 0) rig.push(depth_at(t + clock_ms));
    }
  };
  fly(0, 3500, 60'000);
  rig.push(depth_at(3'600'000));
  PoseSample wrong = pose_at(3500);
  wrong.stamp = ms(3'600'000);
  rig.push(wrong);
  fly(3500, 7000, 60'000);
  fly(7000, 10'500, 30'000);
  rig.close();
  std::size_t frames = 0;
  std::optional<Stamp> last;
  while (auto frame = rig.next().value()) {
    EXPECT_TRUE(!last || *last < frame->stamp);
    last = frame->stamp;
    ++frames;
  }
  EXPECT_GE(frames, 300U - 3U);
  FrameTally tally = rig.tally();
  EXPECT_EQ(tally.of(FrameLoss::kBadStamp), 1U);
  EXPECT_EQ(tally.poses_refused, 1U);
  EXPECT_EQ(tally.pose_clock.back, 1U);
  EXPECT_EQ(tally.pose_clock.last_back, milliseconds(30'000 - 5));
}

TEST(LiveRigDeathTest, refuses_a_camera_that_its_rig_does_not_have) {
  LiveRig rig(kInfo, {.rig = {}, .queue = {.capacity = 2}});
  DepthFrame image = depth_at(0);
  image.camera = 1;
  EXPECT_DEATH(rig.push(image), "no such camera");
  EXPECT_DEATH((void)rig.last_image(1), "no such camera");
}

TEST(LiveRig, gives_up_when_the_camera_is_silent_for_too_long) {
  LiveRig rig(kInfo, {.rig = {}, .queue = {}, .timeout = milliseconds(20)});
  const auto frame = rig.next();
  ASSERT_FALSE(frame);
  EXPECT_THAT(frame.error().text(), HasSubstr("no image has come"));
}

}  // namespace
}  // namespace swiftlet
