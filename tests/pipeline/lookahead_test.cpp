// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/pipeline/lookahead.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/seeds.hpp"
#include "support/synthetic.hpp"
#include "swiftlet/pipeline/mapper.hpp"

namespace swiftlet {
namespace {

using test::Random;

constexpr std::int64_t kPeriod_ns = 33'333'333;  // 30 Hz
const RollingMap::Options kMap{.voxel_m = 0.2, .size_m = {20, 20, 6}, .trigger_m = {1, 1, 1}};

Frame frame_at(std::int64_t ns, const Eigen::Vector3d& p_world) {
  Frame frame = test::wall_frame(test::small_camera(8, 6), 2.0);
  frame.stamp = {ns};
  frame.T_world_camera =
      Transform<World, Camera>::trusted(forward_looking_camera().rotation(), p_world);
  return frame;
}

/// How far the window reaches beyond a place, to the side that `axis_sign` tells along x. [m]
double room(const RollingMap& map, double x_m, int axis_sign) {
  const double block_m = map.voxel_m() * kBlockEdge;
  return axis_sign > 0 ? map.window().end().x * block_m - x_m
                       : x_m - map.window().first.x * block_m;
}

TEST(Lookahead, gives_room_ahead_at_every_speed_and_keeps_the_vehicle_inside) {
  Random random;
  for (const double speed_mps : {0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 15.0}) {
    for (const int way : {1, -1}) {
      Lookahead lookahead({.lookahead_s = 1.0}, kMap);
      auto map = RollingMap::create(kMap);
      const std::size_t blocks = map->window().block_count();
      for (int i = 0; i < 150; ++i) {
        const double x_m = way * speed_mps * 1e-9 * static_cast<double>(i * kPeriod_ns);
        const Eigen::Vector3d noise = random.vector(-0.003, 0.003);
        const Eigen::Vector3d p_world = Eigen::Vector3d(x_m, 0, 0) + noise;
        map->recentre(lookahead.middle_for(frame_at(i * kPeriod_ns, p_world)), nullptr);
        ASSERT_GT(room(*map, x_m, -way), 2.0) << speed_mps << " m/s, frame " << i;
        if (i < 10) continue;  // has its velocity
        // 10 m and one spare block; the trigger box, half a block and noise may take their part.
        const double ahead_m = 10.0 + std::min(speed_mps, 5.0);
        ASSERT_GT(room(*map, x_m, way), ahead_m - 1.0 - 0.8 - 0.4) << speed_mps << ", frame " << i;
      }
      EXPECT_EQ(map->window().block_count(), blocks);
      EXPECT_NEAR(lookahead.velocity_mps().x(), way * speed_mps, 0.25);
    }
  }
}

TEST(Lookahead, comes_back_to_the_vehicle_when_it_stops) {
  Lookahead lookahead({.lookahead_s = 1.0}, kMap);
  double x_m = 0.0;
  Eigen::Vector3d middle;
  for (int i = 0; i < 60; ++i) {
    if (i < 30) x_m += 0.2;
    middle = lookahead.middle_for(frame_at(i * kPeriod_ns, {x_m, 0, 0}));
    if (i == 29) {
      EXPECT_GT(middle.x(), x_m + 4.0);
    }
  }
  EXPECT_EQ(middle, Eigen::Vector3d(x_m, 0, 0));
}

TEST(Lookahead, is_not_led_astray_by_a_jump_of_the_tracker) {
  Lookahead lookahead({.lookahead_s = 1.0}, kMap);
  for (int i = 0; i < 40; ++i) {
    const double jump_m = i >= 20 ? 3.0 : 0.0;  // 90 m/s, for one step
    const Eigen::Vector3d p(0.02 * i + jump_m, 0, 0);
    const Eigen::Vector3d ahead = lookahead.middle_for(frame_at(i * kPeriod_ns, p)) - p;
    ASSERT_LT(ahead.norm(), 0.7) << i;
  }
}

TEST(Lookahead, forgets_its_velocity_after_a_gap_when_time_goes_back_and_in_a_new_world) {
  const auto flying = [] {
    Lookahead lookahead({.lookahead_s = 1.0}, kMap);
    for (int i = 0; i < 20; ++i)
      (void)lookahead.middle_for(frame_at(i * kPeriod_ns, {0.1 * i, 0, 0}));
    EXPECT_NEAR(lookahead.velocity_mps().x(), 3.0, 1e-6);
    return lookahead;
  };
  const Eigen::Vector3d p(2.0, 0, 0);
  EXPECT_EQ(flying().middle_for(frame_at(19 * kPeriod_ns + 600'000'000, p)), p);
  EXPECT_EQ(flying().middle_for(frame_at(5, p)), p);
  EXPECT_EQ(flying().middle_for(frame_at(INT64_MIN, p)), p);
  Frame elsewhere = frame_at(20 * kPeriod_ns, p);
  elsewhere.pose_epoch = 1;
  EXPECT_EQ(flying().middle_for(elsewhere), p);
  EXPECT_GT(flying().middle_for(frame_at(19 * kPeriod_ns, p)).x(), 4.0) << "the same stamp twice";
}

TEST(Lookahead, never_leaves_the_limits_of_the_map) {
  Lookahead lookahead({.lookahead_s = 10.0}, kMap);
  auto map = RollingMap::create(kMap);
  for (int i = 0; i < 20; ++i) {
    const double x_m = std::min(999'999.0 + 0.5 * i, 999'999.999);
    map->recentre(lookahead.middle_for(frame_at(i * kPeriod_ns, {x_m, 0, 0})), nullptr);
  }
}

TEST(Mapper, moves_its_window_ahead_only_if_told_to) {
  MapperConfig config;
  config.quality.max_frozen = 0;  // the test's images are all the same
  const auto fly = [&](double lookahead_s) {
    config.window.lookahead_s = lookahead_s;
    auto mapper = Mapper::create(config);
    MapUpdate update;
    for (int i = 0; i < 30; ++i) {
      Frame frame = test::wall_frame(test::small_camera(), 3.0);
      const Eigen::Vector3d p(0.2 * i, 0, 0);
      frame.stamp = {i * kPeriod_ns};
      frame.T_world_camera =
          Transform<World, Camera>::trusted(forward_looking_camera().rotation(), p);
      update = mapper->integrate(frame);
      EXPECT_EQ(update.verdict, FrameVerdict::kIntegrated);
    }
    return std::pair(update.window_goal.x(), mapper->map().window());
  };
  const auto [here, around] = fly(0.0);
  EXPECT_EQ(here, 0.2 * 29);
  const auto [there, ahead] = fly(0.5);
  EXPECT_NEAR(there, 0.2 * 29 + 3.0, 0.01);
  EXPECT_EQ(ahead.size, around.size);
  EXPECT_GE(ahead.first.x, around.first.x + 1);
}

}  // namespace
}  // namespace swiftlet
