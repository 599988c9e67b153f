// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/tracker/tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace swiftlet::sim {
namespace {

TrackerOptions perfect() {
  TrackerOptions options;
  options.position_noise_m = options.attitude_noise_rad = 0.0;
  options.drift_m_per_sqrt_s = options.yaw_drift_rad_per_sqrt_s = 0.0;
  return options;
}

Flight hover() {
  return Flight::create({{0, {3, -2, 1}, rotation_from_ypr(2.0, 0.1, 0.0)},
                         {60, {3, -2, 1}, rotation_from_ypr(2.0, 0.1, 0.0)}})
      .value();
}

Tracker tracker_with(const TrackerOptions& options, std::uint64_t seed = 1) {
  return {options, seed, hover(), default_mount(), Nanoseconds(0)};
}

std::vector<RawTrackerPose> samples(Tracker tracker, int count) {
  std::vector<RawTrackerPose> poses;
  for (int i = 0; i < count; ++i) poses.push_back(tracker.next());
  return poses;
}

TEST(Tracker, samples_at_200_hz_from_time_zero) {
  const auto poses = samples(tracker_with(perfect()), 401);
  EXPECT_EQ(poses.front().stamp.ns, 0);
  EXPECT_EQ(poses[1].stamp.ns, 5'000'000);
  EXPECT_EQ(poses.back().stamp.ns, 2'000'000'000);
}

TEST(Tracker, calls_its_start_the_origin_and_its_first_heading_straight_ahead) {
  const RawTrackerPose start = tracker_with(perfect()).next();
  EXPECT_LT(start.t_raw_m.norm(), 1e-12);
  // Straight ahead is -z in its axes; tilt remains, as its world is level.
  const Eigen::Vector3d ahead = start.R_raw * Eigen::Vector3d(0, 0, -1);
  EXPECT_NEAR(ahead.x(), 0.0, 1e-12);
  EXPECT_LT(ahead.z(), -0.9);
  // The flight looks down by 0.1 rad, 2.5 degrees of it by the mount (within the mount's other
  // angles, which count in second order).
  EXPECT_NEAR(ahead.y(), -std::sin(0.1 - radians(2.5)), 1e-3);
}

TEST(Tracker, reports_a_climb_along_y_and_an_advance_along_minus_z) {
  const auto flight = Flight::create({{0, {0, 0, 0}}, {1, {1.0, 0.2, 0.5}}}).value();
  const auto mount = mount_from({0, 0, 0}, Eigen::Quaterniond::Identity());
  const auto poses = samples({perfect(), 1, flight, mount, Nanoseconds(0)}, 201);
  EXPECT_LT((poses.back().t_raw_m - Eigen::Vector3d(-0.2, 0.5, -1.0)).norm(), 1e-9);
}

TEST(Tracker, becomes_confident_step_by_step) {
  TrackerOptions options = perfect();
  options.medium_after_s = 0.1;
  options.high_after_s = 0.2;
  const auto poses = samples(tracker_with(options), 60);
  EXPECT_EQ(poses[19].confidence, 1);
  EXPECT_EQ(poses[20].confidence, 2);
  EXPECT_EQ(poses[39].confidence, 2);
  EXPECT_EQ(poses[40].confidence, 3);
}

TEST(Tracker, drifts_like_a_random_walk) {
  TrackerOptions options = perfect();
  options.drift_m_per_sqrt_s = 0.01;
  options.rate_hz = 50;  // the walk does not depend on its steps
  double sum_of_squares = 0.0;
  constexpr int kRuns = 200;
  for (int seed = 0; seed < kRuns; ++seed) {
    const auto poses = samples(tracker_with(options, static_cast<std::uint64_t>(seed)), 201);
    sum_of_squares += (poses.back().t_raw_m - poses.front().t_raw_m).squaredNorm();
  }
  // After 4 s each axis has sigma 0.01 * sqrt(4); 600 values know it to 2.9 %, five times that is
  // 15 %.
  EXPECT_NEAR(std::sqrt(sum_of_squares / (3 * kRuns)), 0.02, 0.003);
}

TEST(Tracker, has_white_noise_of_the_size_asked_for) {
  TrackerOptions options = perfect();
  options.position_noise_m = 0.002;
  double sum_of_squares = 0.0;
  const auto poses = samples(tracker_with(options), 4000);
  for (const auto& pose : poses) sum_of_squares += pose.t_raw_m.squaredNorm();
  EXPECT_NEAR(std::sqrt(sum_of_squares / 12000), 0.002, 5 * 0.002 / std::sqrt(24000.0));
}

TEST(Tracker, jumps_once_when_it_relocalises) {
  TrackerOptions options = perfect();
  options.jump = TrackerOptions::Jump{0.5, {0.3, 0.0, 0.0}, radians(2)};
  const auto poses = samples(tracker_with(options), 200);
  EXPECT_LT(poses[99].t_raw_m.norm(), 1e-12);
  // The jump is in the tracker's own level world: 0.3 m ahead is -z.
  for (std::size_t i = 100; i < poses.size(); ++i)
    EXPECT_LT((poses[i].t_raw_m - Eigen::Vector3d(0, 0, -0.3)).norm(), 1e-12);
  EXPECT_NEAR(poses[99].R_raw.angularDistance(poses[100].R_raw), radians(2), 1e-9);
}

TEST(Tracker, mixes_in_nan_samples_only_when_asked) {
  const auto bad = [](const TrackerOptions& options) {
    int count = 0;
    for (const auto& pose : samples(tracker_with(options), 2000))
      count += !pose.t_raw_m.allFinite();
    return count;
  };
  EXPECT_EQ(bad(TrackerOptions{}), 0);
  TrackerOptions options;
  options.nan_chance = 0.1;
  EXPECT_NEAR(bad(options), 200, 5 * std::sqrt(180.0));
}

TEST(Tracker, repeats_itself_with_the_same_seed_only) {
  const auto last = [](std::uint64_t seed) {
    return samples(tracker_with(TrackerOptions{}, seed), 100).back().t_raw_m;
  };
  EXPECT_EQ(last(3), last(3));
  EXPECT_NE(last(3), last(4));
}

}  // namespace
}  // namespace swiftlet::sim
