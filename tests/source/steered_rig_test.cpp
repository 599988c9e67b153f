// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#if SWIFTLET_HAS_EMBREE

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>
#include <vector>

#include "swiftlet/sim/scene_file.hpp"
#include "swiftlet/source/sim/steered_rig.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

/// A small camera that flies a curve: 2 s, 61 images.
constexpr std::string_view kCurve = R"(seed: 3
camera: { width_px: 48, height_px: 32, rate_hz: 30 }
mount: { at_m: [0.05, -0.02, 0.04], yaw_deg: 2, pitch_deg: 5, roll_deg: -3 }
boxes:
  - { from_m: [3, -5, -5], to_m: [4, 5, 5] }
flight:
  waypoints:
    - { at_m: [0.5, 1.0, 1.5], yaw_deg: 70, pitch_deg: 5 }
    - { at_m: [1.0, 0.0, 1.2], yaw_deg: 10, roll_deg: 10, leg_s: 1 }
    - { at_m: [1.5, 0.5, 1.4], yaw_deg: -30, leg_s: 1 }
)";

class SteeredRigTest : public ::testing::Test {
 protected:
  [[nodiscard]] Transform<World, Body> truth(Stamp stamp) const {
    return scene_.flight.camera_at(stamp - Stamp{}) * scene_.T_body_camera.inverse();
  }
  [[nodiscard]] SteeredRig rig(SteeredRigOptions options = {}) const {
    options.seed = scene_.seed;
    options.rate_hz = scene_.camera.rate_hz;
    return SteeredRig::create(scene_, options, truth(Stamp{})).value();
  }
  /// Moves the rig along the scene's flight and takes what comes.
  std::vector<Frame> fly(SteeredRig& rig, const std::vector<Stamp>& moves) const {
    std::vector<Frame> frames;
    for (const Stamp now : moves) {
      rig.move_to(now, truth(now));
      while (auto frame = rig.next()) frames.push_back(*std::move(frame));
    }
    return frames;
  }
  static std::vector<Stamp> every(Nanoseconds step, Nanoseconds until) {
    std::vector<Stamp> stamps;
    for (Stamp t{}; t - Stamp{} <= until; t = t + step) stamps.push_back(t);
    return stamps;
  }

  sim::Scene scene_ = sim::parse_scene(kCurve, "curve.yaml").value();
};

TEST_F(SteeredRigTest, gives_the_frames_of_a_flight_if_it_is_moved_along_that_flight) {
  const std::string path = ::testing::TempDir() + "swiftlet_steered_rig_test.yaml";
  std::ofstream(path) << kCurve;
  auto source = open_source("sim:" + path).value();
  // All moments at which an instrument measures.
  std::set<Stamp> moves;
  for (int i = 0; i <= 401; ++i) moves.insert(Stamp{i * 5'000'000LL});
  for (int i = 0; i <= 60; ++i) moves.insert(Stamp{std::llround(i * 1e9 / 30.0)});
  SteeredRig steered = rig();
  const auto frames = fly(steered, {moves.begin(), moves.end()});
  std::size_t count = 0, different = 0;
  while (auto expected = source->next().value()) {
    ASSERT_LT(count, frames.size());
    const Frame& frame = frames[count++];
    EXPECT_EQ(frame.stamp, expected->stamp);
    EXPECT_LT((frame.T_world_camera.inverse() * expected->T_world_camera).translation().norm(),
              1e-9);
    const auto ours = frame.depth.raw.pixels();
    const auto theirs = std::as_const(*expected).depth.raw.pixels();
    for (std::size_t i = 0; i < ours.size(); ++i) different += ours[i] != theirs[i] ? 1 : 0;
  }
  EXPECT_EQ(count, frames.size());
  EXPECT_GT(count, 50U);
  // A pose that is rounded otherwise in its last bit may move a reading across a step.
  EXPECT_LE(different, count * 48 * 32 / 10'000);
}

TEST_F(SteeredRigTest, repeats_itself_with_the_same_seed_only) {
  const auto moves = every(milliseconds(2), milliseconds(1500));
  SteeredRig once = rig(), again = rig();
  scene_.seed = 4;
  SteeredRig other = rig();
  const auto a = fly(once, moves), b = fly(again, moves), c = fly(other, moves);
  ASSERT_EQ(a.size(), b.size());
  ASSERT_GT(a.size(), 20U);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_TRUE(std::ranges::equal(a[i].depth.raw.pixels(), b[i].depth.raw.pixels()));
    EXPECT_EQ(a[i].T_world_camera.translation(), b[i].T_world_camera.translation());
  }
  EXPECT_FALSE(std::ranges::equal(a.back().depth.raw.pixels(), c.back().depth.raw.pixels()));
}

TEST_F(SteeredRigTest, believes_to_be_where_it_is_but_for_the_drift_that_it_tells) {
  SteeredRig steered = rig();
  EXPECT_FALSE(steered.believed());
  fly(steered, every(milliseconds(5), milliseconds(1500)));
  ASSERT_TRUE(steered.believed());
  EXPECT_EQ(steered.believed()->stamp, Stamp{1'500'000'000});
  const Eigen::Vector3d believed = steered.believed()->T_world_body.translation();
  const Eigen::Vector3d wrong = believed - truth(steered.believed()->stamp).translation();
  EXPECT_LT((steered.drift().offset_m - wrong).norm(), 1e-12);
  EXPECT_GT(wrong.norm(), 0.0);
  EXPECT_LT(wrong.norm(), 0.02);
}

TEST_F(SteeredRigTest, takes_a_jump_of_the_tracker_out_of_what_it_believes) {
  SteeredRigOptions options;
  options.fault = "jump";  // by half a metre
  options.fault_at = Stamp{1'000'000'000};
  SteeredRig steered = rig(options);
  fly(steered, every(milliseconds(5), milliseconds(1900)));
  EXPECT_EQ(steered.tally().pose_jumps, 1U);
  EXPECT_LT(steered.drift().offset_m.norm(), 0.05);
}

TEST_F(SteeredRigTest, gives_no_frame_when_the_tracker_is_dead) {
  SteeredRigOptions options;
  options.fault = "dead";
  options.fault_at = Stamp{1'000'000'000};
  SteeredRig steered = rig(options);
  const auto frames = fly(steered, every(milliseconds(5), milliseconds(1900)));
  ASSERT_FALSE(frames.empty());
  EXPECT_LE(frames.back().stamp, Stamp{1'000'000'000});
}

TEST_F(SteeredRigTest, is_exact_without_noise) {
  SteeredRigOptions options;
  options.has_noise = false;
  SteeredRig steered = rig(options);
  const auto frames = fly(steered, every(milliseconds(5), milliseconds(500)));
  ASSERT_GT(frames.size(), 10U);
  for (const Frame& frame : frames) {
    const auto expected = truth(frame.stamp) * scene_.T_body_camera;
    // Between the moves it flies straight, and the flight curves: 1 mm in 5 ms.
    EXPECT_LT((frame.T_world_camera.translation() - expected.translation()).norm(), 1e-3);
  }
}

TEST_F(SteeredRigTest, refuses_a_fault_and_a_rate_that_there_are_not) {
  SteeredRigOptions options;
  options.fault = "flood";
  EXPECT_THAT(SteeredRig::create(scene_, options, {}).error().text(), HasSubstr("jump"));
  options = {};
  options.rate_hz = 0.0;
  EXPECT_FALSE(SteeredRig::create(scene_, options, {}));
}

}  // namespace
}  // namespace swiftlet

#endif  // SWIFTLET_HAS_EMBREE
