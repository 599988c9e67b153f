// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/frame/pose_track.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using std::chrono::milliseconds;
using test::Random;

const Eigen::Quaterniond kLevel = Eigen::Quaterniond::Identity();

/// Constant velocity and constant turn rate: what linear + SLERP interpolation must hit exactly.
struct SteadyMotion {
  Eigen::Quaterniond R0;
  Eigen::Vector3d p0_m, v_mps, axis;
  double rate_radps;

  explicit SteadyMotion(Random& random)
      : R0(random.rotation()),
        p0_m(random.vector(-10.0, 10.0)),
        v_mps(random.vector(-3.0, 3.0)),
        axis(random.vector(-1.0, 1.0).normalized()),
        rate_radps(random.real(0.0, 6.0)) {}

  [[nodiscard]] Eigen::Quaterniond rotation(Stamp t) const {
    return R0 * Eigen::Quaterniond(Eigen::AngleAxisd(rate_radps * s(t), axis));
  }
  [[nodiscard]] Eigen::Vector3d position(Stamp t) const { return p0_m + s(t) * v_mps; }
  [[nodiscard]] static double s(Stamp t) { return seconds(t - Stamp{}); }
};

Stamp ms(std::int64_t value) { return Stamp{} + milliseconds(value); }

PoseIntake push_level(PoseTrack& track, Stamp stamp) {
  return track.push(stamp, kLevel, Eigen::Vector3d(static_cast<double>(stamp.ns), 0, 0));
}

TEST(PoseTrack, is_exact_on_motion_of_constant_velocity_and_turn_rate) {
  test::for_each_seed(200, [](Random& random) {
    const SteadyMotion motion(random);
    PoseTrack track;
    for (int i = 0; i <= 20; ++i) {
      const double sign = i % 2 == 0 ? 1.0 : -1.0;  // q and -q are the same rotation
      Eigen::Quaterniond R = motion.rotation(ms(50 * i));
      R.coeffs() *= sign;
      ASSERT_EQ(track.push(ms(50 * i), R, motion.position(ms(50 * i))), PoseIntake::kAdded);
    }
    for (int k = 0; k < 20; ++k) {
      const Stamp t{random.integer<std::int64_t>(0, 1'000'000'000)};
      const auto T = track.at(t);
      ASSERT_TRUE(T);
      EXPECT_LT((T->translation() - motion.position(t)).norm(), 1e-12);
      // A double angle recovered from quaternions near 1 is good to sqrt(2^-53) = 1e-8.
      EXPECT_LT(T->rotation().angularDistance(motion.rotation(t)), 1e-7);
      EXPECT_NEAR(T->rotation().norm(), 1.0, 1e-15);
    }
  });
}

TEST(PoseTrack, gives_back_the_poses_it_received_at_their_own_times) {
  test::for_each_seed(100, [](Random& random) {
    const SteadyMotion motion(random);
    PoseTrack track;
    for (int i = 0; i < 10; ++i)
      track.push(ms(5 * i), motion.rotation(ms(5 * i)), motion.position(ms(5 * i)));
    for (int i = 0; i < 10; ++i)
      EXPECT_EQ(track.at(ms(5 * i))->translation(), motion.position(ms(5 * i)));
  });
}

TEST(PoseTrack, never_extrapolates) {
  PoseTrack track;
  EXPECT_EQ(track.at(ms(0)).error(), PoseMiss::kEmpty);
  push_level(track, ms(100));
  EXPECT_TRUE(track.at(ms(100)));
  push_level(track, ms(110));
  EXPECT_EQ(track.at(ms(100) - Nanoseconds(1)).error(), PoseMiss::kBeforeFirst);
  EXPECT_EQ(track.at(ms(110) + Nanoseconds(1)).error(), PoseMiss::kAfterLast);
}

TEST(PoseTrack, does_not_depend_on_the_order_of_arrival) {
  test::for_each_seed(200, [](Random& random) {
    const SteadyMotion motion(random);
    std::vector<std::int64_t> order;
    for (int i = 0; i < 40; ++i) order.push_back(i * 20);
    PoseTrack sorted, shuffled;
    for (const auto t : order) sorted.push(ms(t), motion.rotation(ms(t)), motion.position(ms(t)));
    std::ranges::shuffle(order, random.engine());
    for (const auto t : order) shuffled.push(ms(t), motion.rotation(ms(t)), motion.position(ms(t)));
    for (int k = 0; k < 20; ++k) {
      const Stamp t{random.integer<std::int64_t>(0, 780'000'000)};
      EXPECT_EQ(sorted.at(t)->translation(), shuffled.at(t)->translation());
      EXPECT_EQ(sorted.at(t)->rotation().coeffs(), shuffled.at(t)->rotation().coeffs());
    }
  });
}

TEST(PoseTrack, keeps_the_first_of_two_poses_of_one_time) {
  PoseTrack track;
  track.push(ms(1), kLevel, {1, 0, 0});
  EXPECT_EQ(track.push(ms(1), kLevel, {2, 0, 0}), PoseIntake::kDuplicateStamp);
  EXPECT_EQ(track.at(ms(1))->translation().x(), 1.0);
  EXPECT_EQ(track.size(), 1U);
  EXPECT_EQ(track.count(PoseIntake::kDuplicateStamp), 1U);
}

TEST(PoseTrack, never_holds_more_than_its_capacity_and_forgets_the_oldest) {
  PoseTrack track({.capacity = 8});
  for (int i = 0; i < 1000; ++i) {
    push_level(track, ms(10 * i));
    ASSERT_LE(track.size(), 8U);
  }
  EXPECT_EQ(track.at(ms(9919)).error(), PoseMiss::kBeforeFirst);
  EXPECT_TRUE(track.at(ms(9920)));
  EXPECT_EQ(push_level(track, ms(9919)), PoseIntake::kTooOld);
  EXPECT_EQ(push_level(track, ms(9921)), PoseIntake::kAdded) << "late, but still remembered";
  EXPECT_EQ(track.size(), 8U);
  EXPECT_EQ(track.at(ms(9920)).error(), PoseMiss::kBeforeFirst) << "the oldest made room";
}

TEST(PoseTrack, refuses_and_counts_poses_that_are_not_finite_or_not_unit) {
  PoseTrack track;
  for (int i = 0; i < 4; ++i) {
    Eigen::Quaterniond q = kLevel;
    q.coeffs()(i) = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(track.push(ms(i), q, Eigen::Vector3d::Zero()), PoseIntake::kNotFinite);
  }
  EXPECT_EQ(track.push(ms(4), kLevel, {0, std::numeric_limits<double>::infinity(), 0}),
            PoseIntake::kNotFinite);
  EXPECT_EQ(track.push(ms(5), Eigen::Quaterniond(0, 0, 0, 0), Eigen::Vector3d::Zero()),
            PoseIntake::kNotUnit);
  EXPECT_EQ(track.push(ms(6), Eigen::Quaterniond(1, 0.1, 0, 0), Eigen::Vector3d::Zero()),
            PoseIntake::kNotUnit);
  EXPECT_EQ(track.count(PoseIntake::kNotFinite), 5U);
  EXPECT_EQ(track.count(PoseIntake::kNotUnit), 2U);
  EXPECT_EQ(track.size(), 0U) << "a refused pose leaves no trace";
}

TEST(PoseTrack, bridges_a_gap_up_to_its_limit_and_not_beyond) {
  PoseTrack track({.max_gap = milliseconds(200)});
  push_level(track, ms(0));
  push_level(track, ms(200));
  push_level(track, ms(401));
  EXPECT_TRUE(track.at(ms(100)));
  EXPECT_EQ(track.at(ms(300)).error(), PoseMiss::kGapTooLong);
  EXPECT_TRUE(track.at(ms(401))) << "at a pose there is nothing to bridge";
}

TEST(PoseTrack, turns_the_short_way_round) {
  PoseTrack track;
  const auto yaw = [](double degrees) {
    return Eigen::Quaterniond(Eigen::AngleAxisd(degrees * M_PI / 180, Eigen::Vector3d::UnitZ()));
  };
  track.push(ms(0), yaw(170), Eigen::Vector3d::Zero());
  track.push(ms(100), yaw(-170), Eigen::Vector3d::Zero());
  EXPECT_LT(track.at(ms(50))->rotation().angularDistance(yaw(180)), 1e-7);
}

}  // namespace
}  // namespace swiftlet
