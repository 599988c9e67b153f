// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The live source on the real SDK's software devices: depth through the SDK, poses over UDP, as
// 2.13's software device has none; cables are pulled, cameras hang. No camera is needed.

#if SWIFTLET_HAS_REALSENSE

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "source/live_flight.hpp"
#include "support/map_bits.hpp"

namespace swiftlet {
namespace {

using namespace test;
using ::testing::HasSubstr;

constexpr const char* kTwoCameras =
    "cameras:\n"
    "  - {name: front, mount: intel_t265_d435}\n"
    "  - {name: left, at_m: [0, 0.1, 0], yaw_deg: 30}\n";

TEST_F(LiveFlight, joins_depth_of_the_sdk_with_poses_from_anywhere) {
  const auto source = open(request("S1", kOneCamera));
  ASSERT_TRUE(source);
  EXPECT_NEAR(source->info().baseline_m.value_or(0.0), 0.05, 1e-9);
  take_off();
  EXPECT_TRUE(fly(*source, 10));
  ASSERT_NE(source->statistics(), nullptr);
  EXPECT_GE(source->statistics()->cameras.front().samples, 10U);
  EXPECT_NEAR(source->statistics()->poses.rate_hz(), 200.0, 1.0);
  land();
}

TEST_F(LiveFlight, goes_on_when_the_camera_was_unplugged_and_is_back) {
  const auto source = fly_off();
  ASSERT_TRUE(source);
  pause();
  devices_->unplug(front_);
  EXPECT_TRUE(wait_for(*source, RigEventKind::kNotStarted));
  devices_->plug(front_, "S1");
  EXPECT_TRUE(wait_for(*source, RigEventKind::kRestarted));
  is_front_silent_ = false;
  EXPECT_TRUE(fly(*source, 5));
  EXPECT_EQ(count(*source, RigEventKind::kUnplugged), 1U);
  EXPECT_EQ(count(*source, RigEventKind::kRestarted), 1U);
  land();
}

TEST_F(LiveFlight, starts_a_camera_again_that_hangs) {
  const auto source = fly_off();
  ASSERT_TRUE(source);
  pause();
  EXPECT_TRUE(wait_for(*source, RigEventKind::kRestarted));
  is_front_silent_ = false;
  EXPECT_TRUE(fly(*source, 5));
  EXPECT_EQ(count(*source, RigEventKind::kStalled), 1U);
  land();
}

TEST_F(LiveFlight, tells_of_a_pose_source_that_falls_silent_and_goes_on_when_it_is_back) {
  const auto source = fly_off();
  ASSERT_TRUE(source);
  is_tracker_silent_ = true;
  std::this_thread::sleep_for(milliseconds(800));
  is_tracker_silent_ = false;
  EXPECT_TRUE(fly(*source, 10));
  EXPECT_EQ(count(*source, RigEventKind::kStalled), 1U);
  FrameTally tally = source->tally();
  EXPECT_GE(tally.of(FrameLoss::kPoseGap) + tally.of(FrameLoss::kNoPose) +
                tally.of(FrameLoss::kPoseStale),
            1U)
      << "nothing is mapped without a pose";
  land();
}

TEST_F(LiveFlight, warns_of_a_slow_port_and_maps_what_it_brings) {
  devices_->unplug(front_);
  devices_->plug(front_, "S1", "2.1");
  auto source = open_realsense(devices_, request("S1", kOneCamera));
  ASSERT_TRUE(source) << source.error().text();
  EXPECT_TRUE(wait_for(**source, RigEventKind::kSlowUsb));
  std::this_thread::sleep_for(milliseconds(200));
  take_off();
  EXPECT_TRUE(fly(**source, 3));
  EXPECT_EQ(count(**source, RigEventKind::kSlowUsb), 1U);
  land();
}

TEST_F(LiveFlight, maps_with_two_cameras_and_goes_on_with_one) {
  devices_->plug(left_, "S2");
  const auto source = open(request("S1,S2", kTwoCameras));
  ASSERT_TRUE(source);
  std::this_thread::sleep_for(milliseconds(200));  // the other one, too
  take_off(true);
  std::array<int, 2> by_camera{};
  for (int i = 0; i < 20; ++i) {
    const auto frame = source->next();
    ASSERT_TRUE(frame && *frame);
    EXPECT_LT(worst_off_the_wall_m(**frame), kWallTolerance_m) << "each behind its own mount";
    ++by_camera[(*frame)->camera];
  }
  EXPECT_GE(by_camera[0], 3);
  EXPECT_GE(by_camera[1], 3);
  pause();
  devices_->unplug(front_);
  EXPECT_TRUE(wait_for(*source, RigEventKind::kUnplugged));
  EXPECT_TRUE(fly(*source, 5)) << "with the other one";
  land();
}

TEST_F(LiveFlight, takes_cameras_without_serial_numbers_as_they_come_and_none_twice) {
  auto two = request("", kTwoCameras);
  auto source = open_realsense(devices_, two);
  ASSERT_FALSE(source) << "there is one";
  EXPECT_THAT(source.error().text(), HasSubstr("connected are: S1"));
  devices_->plug(left_, "S2");
  EXPECT_TRUE(open_realsense(devices_, two));
}

TEST_F(LiveFlight, that_is_recorded_by_the_sdk_replays_to_the_same_map) {
  const auto asked = request("S1", kOneCamera);
  const auto K = SoftwareCamera::intrinsics();
  auto mapper = Mapper::create({});
  ASSERT_TRUE(mapper);
  std::vector<Frame> live_frames;
  {
    auto recording = record_realsense(devices_, asked, folder_ / "rec");
    ASSERT_TRUE(recording) << recording.error().text();
    // The same instruments, live.
    LiveRig rig(SourceInfo{"live:", "+z", std::nullopt, std::nullopt},
                {.rig = asked.rig.rig, .queue = {.capacity = 100}});
    EXPECT_TRUE(wait_for(**recording, RigEventKind::kStarted));
    for (double t_ms = kT0_ms - 100.0; t_ms < kT0_ms + 400.0; t_ms += 5.0) {
      send_pose(t_ms);
      take_pose(pose_at(t_ms), t_ms, RS2_TIMESTAMP_DOMAIN_SYSTEM_TIME, rig);
    }
    for (int k = 0; k < 10; ++k) {
      const double t_ms = kT0_ms + 12.0 + 33.0 * k;
      const auto pixels = wall_seen_at(t_ms, K);
      front_.deliver(pixels, t_ms, k + 1);
      DepthImage depth{Image<std::uint16_t>(kWidth, kHeight), 0.001F};
      std::ranges::copy(pixels, depth.raw.row(0).data());
      rig.push(
          DepthFrame{{std::llround(t_ms * 1e6)}, std::move(depth), K, 0, ClockDomain::kSystem});
      std::this_thread::sleep_for(milliseconds(20));
    }
    rig.close();
    while (true) {
      const auto frame = rig.next();
      ASSERT_TRUE(frame) << frame.error().text();
      if (!*frame) break;
      mapper->integrate(**frame);
      live_frames.push_back(std::move(**frame));
    }
    const auto streams = (*recording)->streams();
    ASSERT_EQ(streams.size(), 2U);
    EXPECT_EQ(streams[1].samples, 100U);
    EXPECT_EQ(streams[0].file.filename(), "depth_S1.bag");
  }
  const std::filesystem::path recorded = folder_ / "rec";
  const std::string replay =
      fmt::format("bag:{0}/depth_S1.bag,{0}/poses.txt?pose_axes=t265&rig={1}", recorded.string(),
                  (folder_ / "rig.yaml").string());
  auto replayed = open_source(replay);
  ASSERT_TRUE(replayed) << replayed.error().text();
  for (const Frame& live : live_frames) {
    const auto frame = (*replayed)->next();
    ASSERT_TRUE(frame && *frame);
    // The SDK rounds stamps to 0.24 us when it records.
    EXPECT_NEAR(seconds((*frame)->stamp - live.stamp), 0.0, 0.25e-6);
    EXPECT_LT(((*frame)->T_world_camera.translation() - live.T_world_camera.translation()).norm(),
              1e-6);
    EXPECT_EQ((*frame)->depth.unit_m, live.depth.unit_m);
    EXPECT_TRUE((*frame)->intrinsics == live.intrinsics);
    for (int v = 0; v < kHeight; ++v)
      ASSERT_TRUE(std::ranges::equal((*frame)->depth.raw.row(v), live.depth.raw.row(v)));
  }
  const MapBits live = bits_of(*mapper);
  EXPECT_EQ(live.frames, 10U);
  EXPECT_EQ(map_bits(replay), live);
  const auto refused = record_realsense(devices_, asked, recorded);
  ASSERT_FALSE(refused) << "recordings are not replaced";
  EXPECT_THAT(refused.error().text(), HasSubstr("the file exists"));
}

TEST(RealsenseAddress, answers_what_cannot_be_meant) {
  const auto answer = [](const char* rest) {
    const auto request = parse_realsense(rest);
    return request ? std::string("accepted") : request.error().text();
  };
  EXPECT_THAT(answer("?profile=big"), HasSubstr("WIDTHxHEIGHT@FPS"));
  EXPECT_THAT(answer("?poses=tcp:9"), HasSubstr("udp:PORT"));
  EXPECT_THAT(answer("?poses=udp:0"), HasSubstr("udp:PORT"));
  EXPECT_THAT(answer("?poses=udp:70000"), HasSubstr("udp:PORT"));
  EXPECT_THAT(answer("?poses=udp:5605"), HasSubstr("rig file")) << "Intel's bracket is a T265's";
  EXPECT_THAT(answer("S1,S2"), HasSubstr("2 serial numbers for 1 camera;"));
  EXPECT_EQ(answer("S1?wait_s=30"), "accepted");
}

}  // namespace
}  // namespace swiftlet

#endif  // SWIFTLET_HAS_REALSENSE
