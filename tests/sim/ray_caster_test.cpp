// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/ray_caster.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/seeds.hpp"

namespace swiftlet::sim {
namespace {

Scene scene_with(std::vector<Object> objects) {
  Scene scene;
  scene.objects = std::move(objects);
  return scene;
}

Hit cast_one(const RayCaster& caster, const Eigen::Vector3d& from,
             const Eigen::Vector3d& direction) {
  const Eigen::Vector3f ray = direction.cast<float>();
  Hit hit;
  caster.cast(from.cast<float>(), {&ray, 1}, {&hit, 1});
  return hit;
}

TEST(RayCaster, hits_a_wire_of_3_mm_within_its_radius_and_misses_it_beyond) {
  test::Random random;
  const auto caster =
      RayCaster::create(scene_with({{"wire", Cylinder{{4, -3, 0.5}, {4, 3, 0.5}, 0.003}}})).value();
  for (int i = 0; i < 2000; ++i) {
    // A level ray at height h meets the wire if |h - 0.5| < 1.5 mm. 16 sides leave 0.03 mm, floats
    // 0.001 mm at 4 m.
    const double offset_m = random.real(-0.003, 0.003);
    if (std::abs(std::abs(offset_m) - 0.0015) < 5e-5) continue;
    const Eigen::Vector3d from(0, random.real(-2, 2), 0.5 + offset_m);
    const bool is_hit = std::isfinite(cast_one(caster, from, {1, 0, 0}).distance);
    EXPECT_EQ(is_hit, std::abs(offset_m) < 0.0015) << offset_m << ", " << random.repeat();
  }
}

TEST(RayCaster, meets_a_turned_box_where_the_slab_test_does) {
  test::Random random;
  for (int trial = 0; trial < 50; ++trial) {
    const Box box{random.vector(-1, 1), random.vector(0.2, 2.0), random.rotation()};
    const auto caster = RayCaster::create(scene_with({{"box", box}})).value();
    for (int i = 0; i < 50; ++i) {
      const Eigen::Vector3d from = 6.0 * random.vector(-1, 1).normalized();
      const Eigen::Vector3d direction = random.vector(-1.5, 1.5) - from;
      const Eigen::Vector3d o = box.R_world_box.conjugate() * (from - box.centre_m);
      const Eigen::Vector3d d = box.R_world_box.conjugate() * direction;
      const Eigen::Array3d t0 = (-0.5 * box.size_m - o).array() / d.array();
      const Eigen::Array3d t1 = (0.5 * box.size_m - o).array() / d.array();
      const double enter = t0.min(t1).maxCoeff();
      const double leave = t0.max(t1).minCoeff();
      if (std::abs(enter - leave) < 1e-4) continue;  // grazes an edge
      const Hit hit = cast_one(caster, from, direction);
      ASSERT_EQ(std::isfinite(hit.distance), enter < leave) << random.repeat();
      if (enter < leave) {
        EXPECT_NEAR(hit.distance, enter, 1e-5) << random.repeat();
      }
    }
  }
}

TEST(RayCaster, tells_incidence_and_texture_of_the_surface) {
  Scene scene = scene_with({{"wall", Plane{{2, 0, 0}, {-1, 0, 0}}, 1}});
  scene.materials.push_back({"blank", 0.25});
  const auto caster = RayCaster::create(scene).value();
  const Hit hit = cast_one(caster, {0, 0, 0}, {1, std::tan(1.0), 0});
  EXPECT_NEAR(hit.cos_incidence, std::cos(1.0), 1e-5);
  EXPECT_EQ(hit.texture, 0.25F);
  EXPECT_FALSE(std::isfinite(cast_one(caster, {0, 0, 0}, {-1, 0, 0}).distance));
}

TEST(RayCaster, moves_what_moves_and_leaves_the_rest) {
  Scene scene = scene_with({{"wall", Plane{{5, 0, 0}, {-1, 0, 0}}}});
  scene.movers.push_back({"cube",
                          {{"cube", Box{{0, 0, 0}, {1, 1, 1}}}},
                          Flight::create({{0, {3, 4, 0}}, {2, {3, -4, 0}}}).value()});
  auto caster = RayCaster::create(scene).value();
  const auto ahead_m = [&](double t_s) {
    caster.move_to(Nanoseconds(std::llround(t_s * 1e9)));
    return cast_one(caster, {0, 0, 0}, {1, 0, 0}).distance;
  };
  EXPECT_NEAR(ahead_m(0.0), 5.0, 1e-5);
  EXPECT_NEAR(ahead_m(1.0), 2.5, 1e-5);  // its face, half way
  EXPECT_NEAR(ahead_m(2.0), 5.0, 1e-5);
}

TEST(RayCaster, sees_a_point_unless_something_stands_before_it) {
  const auto caster = RayCaster::create(scene_with({{"wall", Plane{{4, 0, 0}, {-1, 0, 0}}},
                                                    {"box", Box{{2, 0, 0}, {0.1, 1, 1}}}}))
                          .value();
  const std::vector<Eigen::Vector3f> points{{4, 0, 0}, {4, 3, 0}, {1.95F, 0, 0}};
  std::vector<std::uint8_t> is_seen(3);
  caster.look({0, 0, 0}, points, is_seen);
  EXPECT_EQ(is_seen, (std::vector<std::uint8_t>{0, 1, 1}));
}

TEST(RayCaster, refuses_geometry_and_looks_from_beyond_all_reach_instead_of_aborting) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float far : {1e20F, 3e6F, kNan, std::numeric_limits<float>::infinity()}) {
    const TriangleMesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, far, 0}}, {{0, 1, 2}}, {0}};
    const auto caster = RayCaster::create(scene_with({{"far", mesh}}));
    ASSERT_FALSE(caster) << far;
    EXPECT_EQ(caster.error().code, ErrorCode::kInvalidConfig);
  }
  const auto caster =
      RayCaster::create(scene_with({{"wall", Plane{{2, 0, 0}, {-1, 0, 0}}}})).value();
  for (const double far : {-1e20, 1e30, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(std::isfinite(cast_one(caster, {far, 0, 0}, {1, 0, 0}).distance)) << far;
}

TEST(RayCaster, refuses_more_triangles_than_a_machine_can_hold) {
  const std::vector<Object> pillars(kMaxTriangles / 2000,
                                    {"", Cylinder{{0, 0, 0}, {0, 0, 1}, 50.0}});
  const auto caster = RayCaster::create(scene_with(pillars));
  ASSERT_FALSE(caster);
  EXPECT_NE(caster.error().what.find("triangles"), std::string::npos);
}

}  // namespace
}  // namespace swiftlet::sim
