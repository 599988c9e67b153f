// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/plan/motion_check.hpp"

#include <gtest/gtest.h>

#include <array>

#include "plan/plan_support.hpp"

namespace swiftlet {
namespace {

using test::Clutter;
using test::Random;

SweepState swept(const MapSnapshot& map, const BodyShape& body, const SweepPolicy& policy,
                 const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const std::array ends{from, to};
  return sweep(map, body, *SweepPath::along(ends), policy)->state;
}

TEST(MotionCheck, says_what_a_sweep_says_of_any_move) {
  test::for_each_seed(20, [](Random& random) {
    Clutter clutter(random);
    const auto map = clutter.made().snapshot();
    const auto field = test::field_of(map, random.real(0.3, 2.0));
    const auto body = *BodyShape::sphere(random.real(0.05, 0.3));
    SweepPolicy policy;
    policy.margin_m = random.real(0.0, 0.1);
    policy.unknown = random.chance(0.5) ? UnknownSpace::kStops : UnknownSpace::kPasses;
    const MotionCheck check(map, field, body, policy);
    int clear = 0;
    for (int i = 0; i < 400; ++i) {
      const Eigen::Vector3d from = random.vector(-2.2, 2.2).cwiseProduct(Eigen::Vector3d(1, 1, .5));
      const Eigen::Vector3d to = from + random.vector(-1.5, 1.5);
      // Both cut the way into pieces that move by 1/16 of a voxel where it is tight.
      SweepPolicy larger = policy;
      larger.margin_m += map.voxel_m() / 8.0;
      const bool is_clear = check.is_clear(from, to);
      clear += is_clear ? 1 : 0;
      EXPECT_TRUE(!is_clear || swept(map, body, policy, from, to) == SweepState::kClear);
      EXPECT_TRUE(is_clear || swept(map, body, larger, from, to) != SweepState::kClear);
      EXPECT_EQ(check.is_clear(from), swept(map, body, policy, from, from) == SweepState::kClear);
    }
    EXPECT_GT(clear, 0);
    EXPECT_LT(clear, 400);
  });
}

TEST(MotionCheck, never_promises_more_room_than_there_is) {
  test::for_each_seed(10, [](Random& random) {
    Clutter clutter(random);
    const auto map = clutter.made().snapshot();
    const auto field = test::field_of(map);
    const auto body = *BodyShape::sphere(0.1);
    const SweepPolicy policy;
    const MotionCheck check(map, field, body, policy);
    for (int i = 0; i < 300; ++i) {
      const Eigen::Vector3d p = random.vector(-2.0, 2.0).cwiseProduct(Eigen::Vector3d(1, 1, 0.4));
      const double room_m = check.room_m(p);
      if (room_m <= 0.0) continue;
      EXPECT_FALSE(test::touches_by_hand(map, p, 0.1 + room_m, UnknownSpace::kStops));
    }
  });
}

}  // namespace
}  // namespace swiftlet
