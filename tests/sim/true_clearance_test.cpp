// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/vehicle/true_clearance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "support/seeds.hpp"
#include "swiftlet/sim/vehicle/triangle_distance.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;
using Pose = Transform<World, Body>;

Scene objects_in_scene(std::vector<Object> objects) {
  Scene scene;
  scene.objects = std::move(objects);
  return scene;
}
TrueClearance clearance_in(const Scene& scene, const BodyShape& body) {
  return TrueClearance::create(scene, body).value();
}
Pose body_at(const Vector3d& p, const Eigen::Quaterniond& R = Eigen::Quaterniond::Identity()) {
  return Pose::trusted(R, p);
}

Triangle3d any_triangle(test::Random& random) {
  return {random.vector(-1, 1), random.vector(-1, 1), random.vector(-1, 1)};
}
Vector3d inside(const Triangle3d& t, double a, double b) {
  if (a + b > 1.0) return inside(t, 1.0 - a, 1.0 - b);
  return t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]);
}

constexpr int kPieces = 60;
// No point of a triangle or segment with sides of at most 4 is farther from a sample.
constexpr double kGrain_m = 4.0 * 1.42 / kPieces;

TEST(TriangleDistance, is_what_a_search_over_points_finds) {
  test::Random random;
  for (int trial = 0; trial < 60; ++trial) {
    const Triangle3d a = any_triangle(random);
    const Triangle3d b = any_triangle(random);
    const Segment3d s{random.vector(-1, 1), random.vector(-1, 1)};
    double point_to_a = 1e9, s_to_a = 1e9, b_to_a = 1e9;
    for (int i = 0; i <= kPieces; ++i) {
      const double u = static_cast<double>(i) / kPieces;
      s_to_a = std::min(s_to_a, distance(s[0] + u * (s[1] - s[0]), a));
      for (int j = 0; j <= kPieces; ++j) {
        const double v = static_cast<double>(j) / kPieces;
        point_to_a = std::min(point_to_a, (inside(a, u, v) - s[0]).norm());
        b_to_a = std::min(b_to_a, distance(inside(b, u, v), a));
      }
    }
    EXPECT_LE(distance(s[0], a), point_to_a + 1e-12) << random.repeat();
    EXPECT_GE(distance(s[0], a), point_to_a - kGrain_m) << random.repeat();
    EXPECT_LE(distance(s, a), s_to_a + 1e-12) << random.repeat();
    EXPECT_GE(distance(s, a), s_to_a - kGrain_m) << random.repeat();
    EXPECT_LE(distance(a, b), b_to_a + 1e-12) << random.repeat();
    EXPECT_GE(distance(a, b), b_to_a - kGrain_m) << random.repeat();
    EXPECT_EQ(distance(a, b), distance(b, a));
  }
}

TEST(TriangleDistance, bears_triangles_that_are_lines_or_points) {
  const Triangle3d point{Vector3d(1, 0, 0), Vector3d(1, 0, 0), Vector3d(1, 0, 0)};
  const Triangle3d line{Vector3d(1, -1, 0), Vector3d(1, 1, 0), Vector3d(1, 0.2, 0)};
  EXPECT_DOUBLE_EQ(distance(Vector3d(0, 0, 0), point), 1.0);
  EXPECT_DOUBLE_EQ(distance(Vector3d(0, 0, 0), line), 1.0);
  EXPECT_DOUBLE_EQ(distance(line, point), 0.0);
  const Segment3d through{Vector3d(0, 0, 0), Vector3d(3, 0, 0)};
  EXPECT_DOUBLE_EQ(distance(through, line), 0.0);
}

TEST(TrueClearance, of_a_sphere_before_a_turned_box_is_the_distance_of_its_centre_less_its_radius) {
  test::Random random;
  for (int trial = 0; trial < 30; ++trial) {
    const Box box{random.vector(-1, 1), random.vector(0.2, 2), random.rotation()};
    const double radius_m = random.real(0.0, 0.3);
    const auto truth = clearance_in(objects_in_scene({{"box", box}}), *BodyShape::sphere(radius_m));
    for (int i = 0; i < 50; ++i) {
      const Vector3d p = random.vector(-4, 4);
      const Vector3d p_box = box.R_world_box.conjugate() * (p - box.centre_m);
      const double outside_m = (p_box.cwiseAbs() - 0.5 * box.size_m).cwiseMax(0.0).norm();
      const double expected_m = std::clamp(outside_m - radius_m, 0.0, 5.0);
      // Embree keeps corners as floats.
      EXPECT_NEAR(truth.clearance_m(body_at(p, random.rotation())), expected_m, 1e-5)
          << random.repeat();
    }
  }
}

TEST(TrueClearance, of_any_body_is_what_points_all_over_it_find) {
  test::Random random;
  const Scene scene =
      objects_in_scene({{"ball", Box{{2, 0, 0}, {0.6, 0.8, 1.0}, random.rotation()}},
                        {"rod", Cylinder{{-1, -2, 0}, {1, -2, 1}, 0.01}},
                        {"wall", Plane{{0, 3, 0}, {0, -1, 0.3}, 8.0}}});
  const auto points = clearance_in(scene, *BodyShape::sphere(0.0));
  const Vector3d half(0.3, 0.2, 0.1);
  const std::array bodies{*BodyShape::capsule({-0.3, 0, 0}, {0.3, 0, 0}, 0.05),
                          *BodyShape::box(2.0 * half)};
  for (int trial = 0; trial < 200; ++trial) {
    const Pose pose = body_at(random.vector(-2.5, 2.5), random.rotation());
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      double sampled_m = 5.0;
      for (int i = 0; i < 400; ++i) {
        const Vector3d spread = random.vector(-1, 1);
        Vector3d p_body = b == 0 ? Vector3d(0.3 * spread.x(), 0, 0) : spread.cwiseProduct(half);
        if (b == 1) p_body[i % 3] = std::copysign(half[i % 3], spread[i % 3]);
        const double radius_m = b == 0 ? 0.05 : 0.0;
        sampled_m = std::min(sampled_m, std::max(0.0, points.distance_m(pose * p_body) - radius_m));
      }
      const double clearance_m = clearance_in(scene, bodies[b]).clearance_m(pose);
      EXPECT_LE(clearance_m, sampled_m + 1e-6) << random.repeat();
      EXPECT_GE(clearance_m, sampled_m - 0.15) << random.repeat();
      EXPECT_EQ(clearance_in(scene, bodies[b]).collides(pose), clearance_m <= 0.0);
    }
  }
}

TEST(TrueClearance, is_nothing_inside_matter_and_as_much_as_was_asked_for_far_away) {
  const Scene scene = objects_in_scene(
      {{"box", Box{{0, 0, 0}, {4, 4, 4}}}, {"pillar", Cylinder{{9, 0, 0}, {9, 0, 5}, 2.0}}});
  const auto truth = clearance_in(scene, *BodyShape::sphere(0.2));
  EXPECT_EQ(truth.clearance_m(body_at({0, 0, 0})), 0.0);
  EXPECT_EQ(truth.clearance_m(body_at({9, 0.1, 2})), 0.0);
  EXPECT_TRUE(truth.collides(body_at({9, 0.1, 2})));
  EXPECT_EQ(truth.clearance_m(body_at({0, 100, 0}), 3.0), 3.0);
  EXPECT_EQ(truth.distance_m({0, 0, 0}), 0.0);
}

TEST(TrueClearance, finds_the_triangle_that_a_box_holds_wholly) {
  const auto truth = clearance_in(objects_in_scene({{"crumb", Box{{0, 0, 0}, {0.02, 0.02, 0.02}}}}),
                                  *BodyShape::box({0.4, 0.4, 0.4}));
  EXPECT_EQ(truth.clearance_m(body_at({0.1, 0.05, 0.05})), 0.0);
  EXPECT_NEAR(truth.clearance_m(body_at({0.5, 0, 0})), 0.29, 1e-6);
}

TEST(TrueClearance, follows_what_moves) {
  Scene scene = objects_in_scene({{"far", Box{{0, 0, -50}, {1, 1, 1}}}});
  scene.movers.push_back({"box",
                          {{"box", Box{{0, 0, 0}, {1, 1, 1}}}},
                          Flight::create({{0, {0, 0, 0}}, {10, {10, 0, 0}}}).value()});
  auto truth = clearance_in(scene, *BodyShape::sphere(0.5));
  EXPECT_NEAR(truth.clearance_m(body_at({3, 0, 0})), 2.0, 1e-5);
  truth.move_to(std::chrono::seconds(10));
  EXPECT_NEAR(truth.clearance_m(body_at({8, 0, 0})), 1.0, 1e-5);
  EXPECT_EQ(truth.clearance_m(body_at({10.2, 0, 0})), 0.0);
}

}  // namespace
}  // namespace swiftlet::sim
