// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/source/sim/sim_source.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "swiftlet/source/sources.hpp"

#if SWIFTLET_HAS_EMBREE

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "swiftlet/sim/scene_file.hpp"

namespace swiftlet {
namespace {

using ::testing::HasSubstr;

/// A small camera that flies a curve: 2 s, 61 images.
constexpr std::string_view kScene = R"(seed: 3
camera: { width_px: 48, height_px: 32 }
tracker: { position_noise_m: 0.001, attitude_noise_deg: 0.05, drift_m_per_sqrt_s: 0.002, medium_after_s: 0.15 }
mount: { at_m: [0.05, -0.02, 0.04], yaw_deg: 2, pitch_deg: 5, roll_deg: -3 }
boxes:
  - { from_m: [3, -5, -5], to_m: [4, 5, 5] }
flight:
  waypoints:
    - { at_m: [0.5, 1.0, 1.5], yaw_deg: 70, pitch_deg: 5 }
    - { at_m: [1.0, 0.0, 1.2], yaw_deg: 10, roll_deg: 10, leg_s: 1 }
    - { at_m: [1.5, 0.5, 1.4], yaw_deg: -30, leg_s: 1 }
)";

class SimSourceTest : public ::testing::Test {
 protected:
  SimSourceTest() { std::ofstream(path_) << kScene; }

  FrameSourcePtr open(const std::string& options = "") {
    return open_source("sim:" + path_ + options).value();
  }
  static std::vector<Frame> all_frames(FrameSource& source) {
    std::vector<Frame> frames;
    while (auto frame = source.next().value()) frames.push_back(*std::move(frame));
    return frames;
  }
  static std::vector<std::uint16_t> bytes(const std::vector<Frame>& frames) {
    std::vector<std::uint16_t> all;
    for (const Frame& frame : frames)
      all.insert(all.end(), frame.depth.raw.pixels().begin(), frame.depth.raw.pixels().end());
    return all;
  }
  /// Largest distance and angle between delivered and true camera poses.
  std::pair<double, double> worst_pose(const std::vector<Frame>& frames) const {
    const auto flight = sim::load_scene(path_).value().flight;
    std::pair<double, double> worst{0, 0};
    for (const Frame& frame : frames) {
      const auto truth = flight.camera_at(Nanoseconds(frame.stamp.ns));
      const auto& T = frame.T_world_camera;
      worst.first = std::max(worst.first, (T.translation() - truth.translation()).norm());
      worst.second = std::max(worst.second, T.rotation().angularDistance(truth.rotation()));
    }
    return worst;
  }

  std::string path_ = ::testing::TempDir() + "swiftlet_sim_source_test_" +
                      ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".yaml";
};

TEST_F(SimSourceTest, delivers_the_true_poses_within_the_noise_of_the_tracker) {
  const auto source = open();
  const auto [distance_m, angle_rad] = worst_pose(all_frames(*source));
  // White noise of 1 mm and drift of 2 mm * sqrt(2 s) per axis: 5 sigma of sqrt(3) axes are 26 mm;
  // and 0.05 deg tilts the 7 cm lever by nothing that counts. It must not be zero either.
  EXPECT_LT(distance_m, 0.030);
  EXPECT_GT(distance_m, 0.0005);
  EXPECT_LT(angle_rad, 5 * radians(0.05) * std::sqrt(3.0));
  EXPECT_GT(angle_rad, radians(0.01));
}

TEST_F(SimSourceTest, without_noise_delivers_the_scene_frame_itself) {
  const auto source = open("?noise=off");
  const auto frames = all_frames(*source);
  EXPECT_EQ(frames.size(), 61U);
  const auto [distance_m, angle_rad] = worst_pose(frames);
  // Linear interpolation over 5 ms: a dt^2 / 8 with a < 20 m/s^2.
  EXPECT_LT(distance_m, 7e-5);
  EXPECT_LT(angle_rad, 1e-4);
}

TEST_F(SimSourceTest, without_drift_changes_the_poses_and_not_the_images) {
  const auto drifting = all_frames(*open()), steady = all_frames(*open("?drift=off"));
  ASSERT_EQ(steady.size(), drifting.size());
  EXPECT_TRUE(
      std::ranges::equal(steady.back().depth.raw.pixels(), drifting.back().depth.raw.pixels()));
  EXPECT_LT(worst_pose(steady).first, worst_pose(drifting).first);
}

TEST_F(SimSourceTest, refuses_and_counts_frames_before_the_tracker_is_sure_of_itself) {
  const auto source = open();
  const auto frames = all_frames(*source);
  // Medium confidence from 0.15 s on: the images at 0, 33, 67, 100 and 133 ms have no pose.
  EXPECT_EQ(frames.front().stamp.ns, 166'666'667);
  FrameTally tally = source->tally();
  EXPECT_EQ(tally.of(FrameLoss::kNoPose), 5U);
  EXPECT_EQ(tally.poses_refused, 30U);
  EXPECT_EQ(tally.delivered, 56U);
  EXPECT_EQ(tally.delivered + 5U, *source->info().frame_count);
}

TEST_F(SimSourceTest, tells_its_baseline_up_axis_and_length) {
  const auto source = open("?frames=9");
  EXPECT_EQ(source->info().baseline_m, 0.05);
  EXPECT_EQ(source->info().native_up_axis, "+y");
  EXPECT_EQ(source->info().frame_count, 9U);
  EXPECT_EQ(all_frames(*source).size(), 4U);
}

TEST_F(SimSourceTest, repeats_itself_with_the_same_seed_only) {
  const auto run = [&](const std::string& options) { return bytes(all_frames(*open(options))); };
  const auto reference = run("?seed=5");
  EXPECT_EQ(run("?seed=5"), reference);
  EXPECT_NE(run("?seed=6"), reference);
}

TEST_F(SimSourceTest, starts_in_the_middle_of_the_flight_without_moving_the_world) {
  const auto frames = all_frames(*open("?noise=off&start=1"));
  ASSERT_EQ(frames.size(), 31U);
  const auto truth = sim::load_scene(path_).value().flight.camera_at(std::chrono::seconds(1));
  EXPECT_EQ(frames.front().stamp.ns, 0);
  EXPECT_LT((frames.front().T_world_camera.translation() - truth.translation()).norm(), 1e-12);
}

TEST_F(SimSourceTest, tells_what_it_loses_while_no_frame_comes_and_ends_when_it_is_asked_to) {
  const auto source = open("?fault=dead&fault_at=0.6");
  std::size_t lost = 0;
  source->stop_when([&] {
    FrameTally tally = source->tally();
    lost = tally.of(FrameLoss::kPoseStale);
    return lost > 5;
  });
  EXPECT_FALSE(all_frames(*source).empty());
  EXPECT_EQ(lost, 6U) << "it ends at once, and not at the end of the flight";
}

TEST_F(SimSourceTest, refuses_options_that_cannot_be_meant) {
  for (const std::string bad :
       {"?sed=3", "?seed=x", "?noise=maybe", "?drift=1", "?start=-1", "?frames", "?start=99"}) {
    const auto source = open_source("sim:" + path_ + bad);
    ASSERT_FALSE(source) << bad;
    EXPECT_EQ(source.error().code, ErrorCode::kUsage) << bad;
  }
  EXPECT_THAT(open_source("sim:castle").error().text(), HasSubstr("apartment"));
}

TEST(SimSource, sees_the_large_box_at_its_place_in_the_world) {
  const auto source = open_source("sim:large_box?noise=off&frames=1").value();
  const Frame frame = source->next().value().value();
  const auto p_camera = frame.intrinsics.back_project(424, 240, frame.depth.depth_m(424, 240));
  EXPECT_NEAR((frame.T_world_camera * p_camera).x(), 2.1, 0.0005 + 1e-6);
}

}  // namespace
}  // namespace swiftlet

#else

TEST(SimSource, is_listed_as_not_built) {
  const auto source = swiftlet::open_source("sim:apartment");
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().code, swiftlet::ErrorCode::kUnsupported);
}

#endif
