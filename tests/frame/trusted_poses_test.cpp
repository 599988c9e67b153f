// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/frame/trusted_poses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;

constexpr double kPeriod_s = 0.005;  // a T265

Stamp stamp_of(int i) { return Stamp{} + milliseconds(5 * i); }

/// A drone that flies a curve: up to 2.5 m/s and 3 m/s^2, turning at 1 rad/s.
PoseSample flown(int i, const Eigen::Vector3d& off_m = Eigen::Vector3d::Zero(),
                 double off_yaw_rad = 0.0) {
  const double t = kPeriod_s * i;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(off_yaw_rad, Eigen::Vector3d::UnitZ()));
  const Eigen::Vector3d p(1.5 * t, 1.5 * std::sin(t), 0.5 * std::cos(1.3 * t));
  const Eigen::Quaterniond R(Eigen::AngleAxisd(t, Eigen::Vector3d::UnitZ()));
  return {stamp_of(i), turn * R, turn * p + off_m};
}

PoseSample with_noise(PoseSample pose, test::Random& random) {
  pose.t_world_body_m +=
      Eigen::Vector3d(random.gaussian(5e-4), random.gaussian(5e-4), random.gaussian(5e-4));
  return pose;
}

std::size_t refused(const TrustedPoses& poses, PoseRefusal reason) {
  return poses.refused()[static_cast<std::size_t>(reason)];
}
std::size_t refused(const TrustedPoses& poses) {
  std::size_t sum = 0;
  for (const std::size_t count : poses.refused()) sum += count;
  return sum;
}
double off_m(const TrustedPoses& poses, int i) {
  const auto pose = poses.track().find(stamp_of(i));
  EXPECT_TRUE(pose) << "at " << i;
  if (!pose) return std::numeric_limits<double>::infinity();
  return (pose->T_world_body.translation() - flown(i).t_world_body_m).norm();
}

TEST(TrustedPoses, lets_a_noisy_flight_pass_untouched) {
  test::for_each_seed(20, [](test::Random& random) {
    for (const int step : {1, 2, 7, 20}) {  // 200 to 10 Hz
      TrustedPoses poses({});
      for (int i = 0; i < 2000; i += step) poses.push(with_noise(flown(i), random));
      EXPECT_EQ(refused(poses), 0U) << step;
      EXPECT_EQ(poses.jumps(), 0U) << step;
    }
  });
}

TEST(TrustedPoses, refuses_broken_samples_and_counts_each_by_its_reason) {
  TrustedPoses poses({.track = {}, .gates = {.min_confidence = 2}});
  poses.push(flown(0));
  PoseSample nan = flown(1);
  nan.t_world_body_m.z() = std::nan("");
  poses.push(nan);
  PoseSample infinite = flown(1);
  infinite.R_world_body.x() = std::numeric_limits<double>::infinity();
  poses.push(infinite);
  PoseSample long_quaternion = flown(1);
  long_quaternion.R_world_body.coeffs() *= 1.1;
  poses.push(long_quaternion);
  PoseSample unsure = flown(1);
  unsure.confidence = 1;
  poses.push(unsure);
  PoseSample other_clock = flown(1);
  other_clock.clock = ClockDomain::kDevice;
  poses.push(other_clock);
  poses.push(flown(0));
  poses.push(flown(1));
  EXPECT_EQ(refused(poses, PoseRefusal::kNotFinite), 2U);
  EXPECT_EQ(refused(poses, PoseRefusal::kNotUnit), 1U);
  EXPECT_EQ(refused(poses, PoseRefusal::kLowConfidence), 1U);
  EXPECT_EQ(refused(poses, PoseRefusal::kClockMismatch), 1U);
  EXPECT_EQ(refused(poses, PoseRefusal::kDuplicateStamp), 1U);
  EXPECT_EQ(refused(poses), 6U);
  EXPECT_EQ(poses.track().size(), 2U);
}

TEST(TrustedPoses, drops_outliers_that_do_not_last) {
  test::for_each_seed(20, [](test::Random& random) {
    TrustedPoses poses({});
    std::size_t outliers = 0;
    for (int i = 0; i < 400; ++i) {
      PoseSample pose = with_noise(flown(i), random);
      if (i > 5 && random.chance(0.1)) {
        const Eigen::Vector3d way = random.vector(-1, 1);
        if (way.norm() < 0.1) continue;
        pose.t_world_body_m += way.normalized() * random.real(0.3, 100.0);
        ++outliers;
      }
      poses.push(pose);
    }
    EXPECT_GT(outliers, 0U);
    EXPECT_EQ(poses.jumps(), 0U);
    EXPECT_NEAR(static_cast<double>(refused(poses, PoseRefusal::kOutlier)),
                static_cast<double>(outliers), 2.0)
        << "but for those that are still held at the end";
    for (int i = 0; i < 390; ++i) EXPECT_LT(off_m(poses, i), 0.01);
  });
}

TEST(TrustedPoses, takes_a_jump_out_of_all_that_follows_when_the_map_is_kept) {
  test::for_each_seed(20, [](test::Random& random) {
    TrustedPoses poses({});
    const Eigen::Vector3d by_m = random.vector(-1, 1).normalized() * 0.5;
    const double yaw_rad = random.chance(0.5) ? 0.0 : random.real(0.1, 0.5);
    for (int i = 0; i < 600; ++i) {
      const bool has_jumped = i >= 300;
      poses.push(with_noise(has_jumped ? flown(i, by_m, yaw_rad) : flown(i), random));
    }
    EXPECT_EQ(poses.jumps(), 1U);
    EXPECT_EQ(refused(poses), 0U);
    EXPECT_EQ(poses.track().find(stamp_of(300) - Nanoseconds(1)).error(), PoseMiss::kAcrossJump);
    // What is left: 0.5 mm noise and, where it has turned, the noise-free attitude's own 0.1 mrad
    // over the 5 m to the origin.
    for (int i = 0; i < 600; ++i) {
      EXPECT_LT(off_m(poses, i), yaw_rad == 0.0 ? 0.005 : 0.03) << i;
      EXPECT_EQ(poses.track().find(stamp_of(i))->mark.epoch, 0U);
    }
  });
}

TEST(TrustedPoses, follows_a_jump_in_a_new_epoch_when_the_map_is_cleared) {
  TrustedPoses poses({.track = {}, .gates = {.on_jump = JumpPolicy::kClear}});
  const Eigen::Vector3d by_m(0.0, 0.5, 0.0);
  for (int i = 0; i < 20; ++i) poses.push(i < 10 ? flown(i) : flown(i, by_m));
  EXPECT_EQ(poses.track().find(stamp_of(9))->mark.epoch, 0U);
  EXPECT_EQ(poses.track().find(stamp_of(10))->mark.epoch, 1U);
  EXPECT_NEAR(off_m(poses, 15), 0.5, 1e-12);
}

TEST(TrustedPoses, starts_a_new_epoch_after_a_jump_in_a_silence_too_long_to_measure_it) {
  TrustedPoses poses({});
  const Eigen::Vector3d by_m(0.0, 50.0, 0.0);
  for (int i = 0; i < 300; ++i) {
    if (i >= 100 && i < 200) continue;  // 500 ms
    poses.push(i < 100 ? flown(i) : flown(i, by_m));
  }
  EXPECT_EQ(poses.jumps(), 1U);
  EXPECT_EQ(poses.track().find(stamp_of(250))->mark.epoch, 1U);
}

TEST(TrustedPoses, starts_a_new_epoch_when_told_even_where_the_poses_seem_to_go_on) {
  TrustedPoses poses({});
  for (int i = 0; i < 20; ++i) {
    if (i == 10) poses.start_anew();
    poses.push(flown(i));
  }
  EXPECT_EQ(poses.track().find(stamp_of(9))->mark.epoch, 0U);
  EXPECT_EQ(poses.track().find(stamp_of(10))->mark.epoch, 1U);
  EXPECT_EQ(poses.track().find(stamp_of(10) - Nanoseconds(1)).error(), PoseMiss::kAcrossJump);
}

TEST(TrustedPoses, sees_a_jump_behind_a_short_silence) {
  TrustedPoses poses({});
  for (int i = 0; i < 300; ++i) {
    if (i >= 100 && i < 120) continue;  // 100 ms: at 10 m/s twice the jump
    poses.push(i < 100 ? flown(i) : flown(i, {0.5, 0.0, 0.0}));
  }
  EXPECT_EQ(poses.jumps(), 1U);
}

TEST(TrustedPoses, sorts_in_late_poses_that_lie_on_the_path_and_no_others) {
  TrustedPoses poses({});
  for (int i = 0; i < 100; ++i) {
    if (i == 50 || i == 60) continue;
    poses.push(flown(i));
  }
  poses.push(flown(50));
  poses.push(flown(60, {0.3, 0.0, 0.0}));
  EXPECT_EQ(refused(poses, PoseRefusal::kOutlier), 1U);
  EXPECT_EQ(poses.track().size(), 99U);
  EXPECT_LT(off_m(poses, 50), 1e-12);
}

TEST(TrustedPoses, believes_everything_when_its_gates_are_open) {
  test::for_each_seed(20, [](test::Random& random) {
    TrustedPoses poses({.track = {}, .gates = PoseGates::open()});
    for (int i = 0; i < 100; ++i) {
      PoseSample pose = flown(i);
      pose.t_world_body_m = random.vector(-1000, 1000);
      poses.push(pose);
    }
    EXPECT_EQ(refused(poses), 0U);
    EXPECT_EQ(poses.track().size(), 100U);
  });
}

}  // namespace
}  // namespace swiftlet
