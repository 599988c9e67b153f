// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/sight.hpp"

#include <gtest/gtest.h>

#include "swiftlet/eval/truth/movers.hpp"
#include "swiftlet/sim/scene_file.hpp"
#include "swiftlet/source/sim/sim_flight.hpp"
#include "swiftlet/source/sources.hpp"

namespace swiftlet::eval {
namespace {

/// A wall 2 m ahead, 4 m wide and high; a 5 mm rod 1 m ahead, 0.3 m to the left.
sim::Scene wall_and_rod() {
  sim::Scene scene;
  scene.objects = {{"wall", sim::Box{{2.1, 0, 0}, {0.2, 4, 4}}},
                   {"rod", sim::Cylinder{{1.0, 0.3, -1.0}, {1.0, 0.3, 1.0}, 0.005}}};
  return scene;
}

class Sight : public ::testing::Test {
 protected:
  const sim::RayCaster world_ = sim::RayCaster::create(wall_and_rod()).value();
  const PinholeIntrinsics intrinsics_ =
      PinholeIntrinsics::from_field_of_view(848, 480, radians(91.2)).value();
  const Transform<World, Camera> T_world_camera_ =
      Transform<World, Body>{} * forward_looking_camera();
  const TrueView view_{intrinsics_, T_world_camera_};
};

TEST_F(Sight, lines_end_on_what_is_seen_first) {
  std::vector<SightLine> lines;
  lines_of_sight(world_, view_, {}, lines);
  ASSERT_GT(lines.size(), 10'000U);
  for (const SightLine& line : lines) {
    const bool is_wall = std::abs(line.point_m.x() - 2.0F) < 1e-4F;
    const bool is_rod = (line.point_m.head<2>() - Eigen::Vector2f(1.0F, 0.3F)).norm() < 0.0026F;
    EXPECT_TRUE(is_wall || is_rod);
  }
}

TEST_F(Sight, what_lies_out_of_range_gives_no_line) {
  std::vector<SightLine> lines;
  lines_of_sight(world_, view_, {.max_range_m = 1.9}, lines);
  for (const SightLine& line : lines) EXPECT_LT(line.point_m.x(), 1.1F) << "the rod alone";
}

TEST_F(Sight, a_rod_is_in_view_where_nothing_stands_before_it) {
  const std::vector<Eigen::Vector3f> points{{1.0F, 0.3F, 0.0F},   // the rod
                                            {3.0F, 0.0F, 0.0F},   // behind the wall
                                            {-1.0F, 0.0F, 0.0F},  // behind the camera
                                            {1.0F, 0.3F, 0.9F}};  // above the image
  std::vector<float> depths(points.size());
  depths_in_view(world_, view_, {}, points, 0.0025F, depths);
  EXPECT_FLOAT_EQ(depths[0], 1.0F);
  EXPECT_EQ(depths[1], 0.0F);
  EXPECT_EQ(depths[2], 0.0F);
  EXPECT_EQ(depths[3], 0.0F);
}

TEST(TruePose, is_where_an_ideal_tracker_says_it_is) {
  constexpr const char* kPlace = "apartment?noise=off&start=3&frames=5";
  const auto flight = read_sim_flight(kPlace);
  auto source = open_source(std::string("sim:") + kPlace);
  ASSERT_TRUE(flight && source);
  int frames = 0;
  for (auto frame = (*source)->next(); frame && *frame; frame = (*source)->next(), ++frames) {
    const auto truth = flight->true_pose((*frame)->stamp, (*frame)->camera);
    // Interpolated between poses 5 ms apart.
    EXPECT_LT((truth.translation() - (*frame)->T_world_camera.translation()).norm(), 1e-4);
    EXPECT_LT(truth.rotation().angularDistance((*frame)->T_world_camera.rotation()), 1e-3);
  }
  EXPECT_GE(frames, 4);
}

TEST(Movers, are_seen_where_they_are_and_looked_through_where_they_were) {
  const sim::Scene scene = sim::load_scene("walker").value();
  auto world = sim::RayCaster::create(scene).value();
  const auto intrinsics = PinholeIntrinsics::from_field_of_view(848, 480, radians(91.2)).value();
  const VoxelBox box{{20, -20, 0}, {40, 45, 18}};
  const auto sights_at = [&](Nanoseconds t) {
    world.move_to(t);
    std::vector<SightLine> lines;
    lines_of_sight(world, {intrinsics, scene.flight.camera_at(t)}, {}, lines);
    MoverSights sights(box, MoverSight::kNothing);
    see_movers(movers_at(scene, t), lines, 0.1, sights);
    return sights;
  };
  const auto first = sights_at(std::chrono::seconds(4));
  const auto second = sights_at(std::chrono::seconds(5));
  std::size_t body = 0, left = 0;
  first.for_each([&](const VoxelIndex& v, MoverSight sight) {
    if (sight != MoverSight::kMatter) return;
    ++body;
    left += second.at(v) == MoverSight::kLookedThrough ? 1 : 0;
  });
  EXPECT_GT(body, 50U);
  EXPECT_GT(left, body / 2) << "a second later the person is a metre on";
}

}  // namespace
}  // namespace swiftlet::eval
