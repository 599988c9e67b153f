// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include "swiftlet/sim/random/generated_scene.hpp"
#include "swiftlet/sim/random/scene_kinds.hpp"
#include "swiftlet/sim/ray_caster.hpp"
#include "swiftlet/sim/vehicle/triangle_distance.hpp"
#include "swiftlet/sim/vehicle/true_clearance.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const auto& kind : scene_kinds()) names.emplace_back(kind.name);
  return names;
}

class EveryKind : public ::testing::TestWithParam<std::string> {
 protected:
  [[nodiscard]] static GeneratedScene drawn(std::uint64_t seed,
                                            const RandomSceneOptions& options = {}) {
    auto scene = generate(GetParam(), seed, options);
    EXPECT_TRUE(scene) << GetParam() << " seed " << seed << ": " << scene.error().text();
    return std::move(*scene);
  }
};
INSTANTIATE_TEST_SUITE_P(RandomScenes, EveryKind, ::testing::ValuesIn(kind_names()),
                         [](const auto& test) { return test.param; });

TriangleMesh triangles_of(const Scene& scene) {
  TriangleMesh mesh;
  for (const Object& object : scene.objects) append_triangles(object, mesh);
  return mesh;
}

/// A flood through cells that no triangle comes near, told by going from triangle to triangle: the
/// generator goes from place to place and asks Embree.
class FloodedGrid {
 public:
  FloodedGrid(const GeneratedScene& scene, double body_radius_m)
      : low_(scene.task.bounds_m.min()),
        size_((scene.task.bounds_m.sizes() / kCell_m).array().floor().cast<int>()),
        is_blocked_(static_cast<std::size_t>(size_.prod()), false) {
    const TriangleMesh mesh = triangles_of(scene.scene);
    // A body in a blocked cell need not touch; one that goes from centre to centre through cells
    // that are not blocked does not.
    const double reach_m = body_radius_m + 0.5 * kCell_m;
    for (const auto& corners : mesh.triangles) {
      Triangle3d triangle;
      for (std::size_t i = 0; i < 3; ++i) triangle[i] = mesh.vertices_m[corners[i]].cast<double>();
      block(triangle, reach_m);
    }
  }

  [[nodiscard]] bool leads(const Vector3d& from, const Vector3d& to) {
    const Eigen::Vector3i goal = cell(to);
    std::vector<Eigen::Vector3i> open{cell(from)};
    if (is_blocked_[number(open[0])]) return false;
    while (!open.empty()) {
      const Eigen::Vector3i here = open.back();
      open.pop_back();
      if (here == goal) return true;
      for (int axis = 0; axis < 3; ++axis) {
        for (const int step : {-1, 1}) {
          Eigen::Vector3i next = here;
          next[axis] += step;
          if (next[axis] < 0 || next[axis] >= size_[axis] || is_blocked_[number(next)]) continue;
          is_blocked_[number(next)] = true;
          open.push_back(next);
        }
      }
    }
    return false;
  }

 private:
  static constexpr double kCell_m = 0.15;
  [[nodiscard]] std::size_t number(const Eigen::Vector3i& c) const {
    return static_cast<std::size_t>(c.x() + size_.x() * (c.y() + size_.y() * c.z()));
  }
  [[nodiscard]] Eigen::Vector3i cell(const Vector3d& p) const {
    const Eigen::Vector3i c = ((p - low_) / kCell_m).array().floor().cast<int>();
    return c.cwiseMax(0).cwiseMin(size_ - Eigen::Vector3i::Ones());
  }
  void block(const Triangle3d& t, double reach_m) {
    const Vector3d reach = Vector3d::Constant(reach_m);
    const Vector3d least = t[0].cwiseMin(t[1]).cwiseMin(t[2]) - reach;
    const Vector3d most = t[0].cwiseMax(t[1]).cwiseMax(t[2]) + reach;
    const Vector3d high = low_ + kCell_m * size_.cast<double>();
    if ((least.array() > high.array()).any() || (most.array() < low_.array()).any()) return;
    const Eigen::Vector3i first = cell(least), last = cell(most);
    for (int z = first.z(); z <= last.z(); ++z) {
      for (int y = first.y(); y <= last.y(); ++y) {
        for (int x = first.x(); x <= last.x(); ++x) {
          const std::size_t at = number({x, y, z});
          if (is_blocked_[at]) continue;
          const Vector3d centre = low_ + kCell_m * Vector3d(x + 0.5, y + 0.5, z + 0.5);
          is_blocked_[at] = distance(centre, t) < reach_m;
        }
      }
    }
  }

  Vector3d low_;
  Eigen::Vector3i size_;
  std::vector<bool> is_blocked_;
};

TEST_P(EveryKind, has_a_way_for_a_body_of_40_cm_that_another_search_finds) {
  for (const std::uint64_t seed : {1, 2}) {
    const GeneratedScene scene = drawn(seed);
    FloodedGrid grid(scene, 0.2);
    EXPECT_TRUE(grid.leads(scene.task.start_m, scene.task.goal_m)) << "seed " << seed;
  }
}

TEST_P(EveryKind, keeps_its_way_and_its_flight_clear_of_every_surface) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const GeneratedScene scene = drawn(seed);
    const auto truth = TrueClearance::create(scene.scene, *BodyShape::sphere(0.0)).value();
    const auto& way = scene.task.way_m;
    EXPECT_EQ(way.front(), scene.task.start_m);
    EXPECT_EQ(way.back(), scene.task.goal_m);
    for (std::size_t i = 0; i + 1 < way.size(); ++i) {
      for (double share = 0.0; share <= 1.0; share += 0.02) {
        const Vector3d p = way[i] + share * (way[i + 1] - way[i]);
        ASSERT_GE(truth.distance_m(p), kWayClearance_m) << "seed " << seed << ", leg " << i;
        ASSERT_TRUE(scene.task.bounds_m.contains(p));
      }
    }
    const Flight& flight = scene.scene.flight;
    for (Nanoseconds t{0}; t < flight.duration(); t += std::chrono::milliseconds(100))
      ASSERT_GE(truth.distance_m(flight.at(t).translation()), kWayClearance_m - 1e-6);
    EXPECT_LT((flight.at(flight.duration()).translation() - scene.task.goal_m).norm(), 1e-9);
  }
}

bool same_bits(const TriangleMesh& a, const TriangleMesh& b) {
  return a.vertices_m.size() == b.vertices_m.size() && a.triangles == b.triangles &&
         a.materials == b.materials &&
         std::memcmp(a.vertices_m.data(), b.vertices_m.data(),
                     a.vertices_m.size() * sizeof(Eigen::Vector3f)) == 0;
}

TEST_P(EveryKind, is_the_same_to_the_bit_with_the_same_seed_alone) {
  const GeneratedScene once = drawn(3), again = drawn(3), other = drawn(4);
  EXPECT_TRUE(same_bits(triangles_of(once.scene), triangles_of(again.scene)));
  EXPECT_EQ(once.task.start_m, again.task.start_m);
  EXPECT_EQ(once.task.way_m, again.task.way_m);
  EXPECT_FALSE(same_bits(triangles_of(once.scene), triangles_of(other.scene)));
}

double thickness(const Object& object) {
  if (const auto* cylinder = std::get_if<Cylinder>(&object.shape)) return cylinder->diameter_m;
  if (const auto* box = std::get_if<Box>(&object.shape)) return box->size_m.minCoeff();
  return 1.0;  // sheets: the ground, the rock
}
double thinnest(const Scene& scene) {
  double least = 1.0;
  for (const Object& object : scene.objects) least = std::min(least, thickness(object));
  return least;
}

TEST_P(EveryKind, has_nothing_thinner_than_asked_for_and_something_that_is_thin) {
  double usual = 1.0, thin = 1.0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    usual = std::min(usual, thinnest(drawn(seed).scene));
    thin = std::min(thin, thinnest(drawn(seed, {.thinnest_m = 0.005}).scene));
  }
  EXPECT_GE(usual, 0.010);
  EXPECT_LT(usual, 0.020);
  EXPECT_GE(thin, 0.005);
  EXPECT_LT(thin, 0.010);
}

TEST_P(EveryKind, is_fuller_and_larger_if_asked_to_be) {
  const auto count = [](const GeneratedScene& s) { return s.scene.objects.size(); };
  EXPECT_LT(count(drawn(5, {.density = 0.3})), count(drawn(5)));
  const double usual_m = drawn(5).task.bounds_m.sizes().x();
  EXPECT_GT(drawn(5, {.size_m = 1.5 * usual_m}).task.bounds_m.sizes().x(), 1.3 * usual_m);
}

TEST(RandomScenes, name_what_there_is_and_what_may_be_asked) {
  EXPECT_THAT(generate("forrest", 1).error().text(), HasSubstr("forest"));
  EXPECT_FALSE(generate("forest", 1, {.size_m = 5.0}));
  EXPECT_FALSE(generate("forest", 1, {.density = std::nan("")}));
  EXPECT_FALSE(generate("forest", 1, {.thinnest_m = 0.0}));
}

/// A camera that looks out of the scene sees nothing there, and a map never learns that it is free.
TEST(CaveScene, is_closed_around_start_and_goal) {
  std::vector<Eigen::Vector3f> directions;
  for (int i = 0; i < 2000; ++i) {  // a spiral over the sphere
    const double z = (2.0 * i + 1.0) / 2000.0 - 1.0, r = std::sqrt(1.0 - z * z);
    directions.push_back(Vector3d(r * std::cos(2.4 * i), r * std::sin(2.4 * i), z).cast<float>());
  }
  for (std::uint64_t seed = 100; seed < 140; ++seed) {
    const auto cave = generate("cave", seed);
    ASSERT_TRUE(cave);
    const auto caster = RayCaster::create(cave->scene);
    ASSERT_TRUE(caster);
    std::vector<Hit> hits(directions.size());
    for (const Vector3d& from : {cave->task.start_m, cave->task.goal_m}) {
      caster->cast(from.cast<float>(), directions, hits);
      EXPECT_TRUE(std::ranges::all_of(hits, [](const Hit& hit) { return hit.distance < 1e3F; }))
          << seed;
    }
  }
}

}  // namespace
}  // namespace swiftlet::sim
