// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/rays/ray_method.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

#include "support/seeds.hpp"

namespace swiftlet {

void PrintTo(const RayMethod& method, std::ostream* out) { *out << method.name; }

namespace {

using test::Random;

/// Voxels with less of the segment inside than this are on the edge of being crossed: either answer
/// is right. 1e-9 of a voxel: a hundred times the rounding of coordinates up to 1e5.
constexpr double kTouch = 1e-9;

/// Length [voxels] of the segment inside one voxel, by clipping against its six faces. Slow,
/// simple, and no code of ours.
double intersection_length(const GridRay& ray, const VoxelIndex& v) {
  const Eigen::Vector3d d = ray.to - ray.from;
  const double low[3] = {double(v.x), double(v.y), double(v.z)};
  double t0 = 0.0, t1 = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    if (d[axis] == 0.0) {
      if (ray.from[axis] < low[axis] || ray.from[axis] >= low[axis] + 1.0) return -1.0;
      continue;
    }
    double enter = (low[axis] - ray.from[axis]) / d[axis],
           leave = (low[axis] + 1.0 - ray.from[axis]) / d[axis];
    if (enter > leave) std::swap(enter, leave);
    t0 = std::max(t0, enter);
    t1 = std::min(t1, leave);
  }
  return t1 < t0 ? -1.0 : (t1 - t0) * d.norm();
}

constexpr VoxelBox kBox{{-9, -7, -5}, {8, 7, 6}};

std::vector<VoxelIndex> trace(TraceRay method, const GridRay& ray, const VoxelBox& box = kBox) {
  std::vector<VoxelIndex> out(max_voxels(box));
  out.resize(method(ray, box, out));
  return out;
}

template <class Visit>
void for_each_voxel(const VoxelBox& box, Visit&& visit) {
  for (int x = box.first.x; x <= box.last.x; ++x)
    for (int y = box.first.y; y <= box.last.y; ++y)
      for (int z = box.first.z; z <= box.last.z; ++z) visit(VoxelIndex{x, y, z});
}

/// Rays of every awkward kind: general, axis-parallel, along faces, through edges and corners, from
/// outside, of no length, far longer than the box.
GridRay random_ray(Random& random) {
  const auto coordinate = [&] {
    const double v = random.real(-12.0, 12.0);
    return random.chance(0.3) ? std::round(v) : random.chance(0.2) ? std::round(2 * v) / 2 : v;
  };
  GridRay ray{{coordinate(), coordinate(), coordinate()},
              {coordinate(), coordinate(), coordinate()}};
  for (int axis = 0; axis < 3; ++axis) {
    if (random.chance(0.2)) ray.to[axis] = ray.from[axis];
  }
  if (random.chance(0.15)) {  // a diagonal: through corners, if it starts on one
    const double length = random.integer(-9, 9);
    for (int axis = 0; axis < 3; ++axis)
      ray.to[axis] = ray.from[axis] + length * random.integer(-1, 1);
  }
  if (random.chance(0.1)) ray.to += 50.0 * (ray.to - ray.from);
  return ray;
}

class EveryRayMethod : public testing::TestWithParam<RayMethod> {
 protected:
  template <class Law>
  void for_random_rays(Law&& law) {
    Random random;
    for (int i = 0; i < 1200; ++i) {
      const GridRay ray = random_ray(random);
      SCOPED_TRACE(testing::Message() << random.repeat() << ", ray " << i << ": "
                                      << ray.from.transpose() << " -> " << ray.to.transpose());
      law(ray);
      if (HasFatalFailure()) return;
    }
  }
};

TEST_P(EveryRayMethod, visits_only_voxels_of_the_box_that_the_segment_meets) {
  for_random_rays([&](const GridRay& ray) {
    for (const VoxelIndex& v : trace(GetParam().trace, ray)) {
      ASSERT_TRUE(kBox.contains(v));
      // Within rounding of the voxel: widen it by moving the test to the nearest of the 27 voxels
      // around.
      double best = -1.0;
      for_each_voxel(
          {{v.x - 1, v.y - 1, v.z - 1}, {v.x + 1, v.y + 1, v.z + 1}},
          [&](const VoxelIndex& n) { best = std::max(best, intersection_length(ray, n)); });
      ASSERT_GE(std::max(best, intersection_length(ray, v)), 0.0);
      if (GetParam().is_exact && (ray.to - ray.from).norm() > 1.0) {
        const bool is_an_end =
            v == voxel_containing(ray.from, 1.0) || v == voxel_containing(ray.to, 1.0);
        const bool is_on_the_rim = !kBox.contains(voxel_containing(ray.from, 1.0)) ||
                                   !kBox.contains(voxel_containing(ray.to, 1.0));
        ASSERT_TRUE(intersection_length(ray, v) > -kTouch || is_an_end || is_on_the_rim);
      }
    }
  });
}

TEST_P(EveryRayMethod, visits_every_voxel_the_segment_crosses_if_it_is_exact) {
  if (!GetParam().is_exact) return;  // its law is the one above: a subset
  for_random_rays([&](const GridRay& ray) {
    const auto visited = trace(GetParam().trace, ray);
    const std::set<VoxelIndex> set(visited.begin(), visited.end());
    for_each_voxel(kBox, [&](const VoxelIndex& v) {
      if (intersection_length(ray, v) > kTouch) {
        ASSERT_TRUE(set.contains(v)) << v.x << " " << v.y << " " << v.z;
      }
    });
  });
}

TEST_P(EveryRayMethod, visits_no_voxel_twice_and_never_jumps) {
  for_random_rays([&](const GridRay& ray) {
    const auto visited = trace(GetParam().trace, ray);
    ASSERT_EQ(std::set<VoxelIndex>(visited.begin(), visited.end()).size(), visited.size());
    for (std::size_t i = 1; i < visited.size(); ++i) {
      const VoxelIndex &a = visited[i - 1], &b = visited[i];
      ASSERT_LE(std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)}), 1);
    }
  });
}

TEST_P(EveryRayMethod, visits_the_same_voxels_in_reverse_if_it_is_exact) {
  if (!GetParam().is_exact) return;
  for_random_rays([&](const GridRay& ray) {
    const auto there = trace(GetParam().trace, ray);
    const auto back = trace(GetParam().trace, {ray.to, ray.from});
    const std::set<VoxelIndex> a(there.begin(), there.end()), b(back.begin(), back.end());
    for (const VoxelIndex& v : a)
      ASSERT_TRUE(b.contains(v) || intersection_length(ray, v) <= kTouch);
    for (const VoxelIndex& v : b)
      ASSERT_TRUE(a.contains(v) || intersection_length(ray, v) <= kTouch);
  });
}

TEST_P(EveryRayMethod, starts_in_the_first_voxel_and_ends_in_the_last) {
  for_random_rays([&](const GridRay& ray) {
    const VoxelIndex first = voxel_containing(ray.from, 1.0), last = voxel_containing(ray.to, 1.0);
    if (!kBox.contains(first) || !kBox.contains(last)) return;
    const auto visited = trace(GetParam().trace, ray);
    ASSERT_FALSE(visited.empty());
    ASSERT_EQ(visited.front(), first);
    ASSERT_EQ(visited.back(), last);
  });
}

TEST_P(EveryRayMethod, visits_one_voxel_when_the_ray_has_no_length) {
  EXPECT_EQ(trace(GetParam().trace, {{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}}),
            (std::vector<VoxelIndex>{{0, 0, 0}}));
  EXPECT_EQ(trace(GetParam().trace, {{-1.0, 2.0, 3.0}, {-1.0, 2.0, 3.0}}),
            (std::vector<VoxelIndex>{{-1, 2, 3}}));
}

TEST_P(EveryRayMethod, visits_nothing_when_the_ray_misses_the_box) {
  EXPECT_TRUE(trace(GetParam().trace, {{20, 0.5, 0.5}, {30, 0.5, 0.5}}).empty());
  EXPECT_TRUE(trace(GetParam().trace, {{-20, 20.5, 0.5}, {30, 20.5, 0.5}}).empty());
}

TEST_P(EveryRayMethod, runs_straight_along_each_axis) {
  for (int axis = 0; axis < 3; ++axis) {
    GridRay ray{{0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}};
    ray.to[axis] = -4.5;
    const auto visited = trace(GetParam().trace, ray);
    ASSERT_EQ(visited.size(), 6U);
    for (int i = 0; i < 6; ++i) {
      const VoxelIndex v = visited[static_cast<std::size_t>(i)];
      EXPECT_EQ((std::array{v.x, v.y, v.z}[static_cast<std::size_t>(axis)]), -i);
    }
  }
}

TEST_P(EveryRayMethod, is_right_far_from_the_origin) {
  Random random;
  for (int i = 0; i < 300; ++i) {
    const VoxelIndex at{random.integer(-2000000, 2000000), random.integer(-2000000, 2000000),
                        random.integer(-9, 9)};
    const Eigen::Vector3d offset(at.x, at.y, at.z);
    const GridRay near_ray{random.vector(-4, 4), random.vector(-4, 4)};
    const GridRay far_ray{near_ray.from + offset, near_ray.to + offset};
    const VoxelBox box{{at.x - 5, at.y - 5, at.z - 5}, {at.x + 5, at.y + 5, at.z + 5}};
    const auto visited = trace(GetParam().trace, far_ray, box);
    const std::set<VoxelIndex> set(visited.begin(), visited.end());
    for (const VoxelIndex& v : visited)
      ASSERT_GT(intersection_length(far_ray, v), -1e-6) << random.repeat();
    if (!GetParam().is_exact) continue;
    for_each_voxel(box, [&](const VoxelIndex& v) {
      if (intersection_length(far_ray, v) > 1e-6) {
        ASSERT_TRUE(set.contains(v)) << random.repeat();
      }
    });
  }
}

TEST_P(EveryRayMethod, crosses_a_corner_without_visiting_the_voxels_it_only_touches) {
  const auto visited = trace(GetParam().trace, {{0.5, 0.5, 0.5}, {2.5, 2.5, 2.5}});
  EXPECT_EQ(visited, (std::vector<VoxelIndex>{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}));
}

INSTANTIATE_TEST_SUITE_P(Registered, EveryRayMethod,
                         testing::ValuesIn(ray_methods().begin(), ray_methods().end()),
                         [](const auto& param_info) { return std::string(param_info.param.name); });

TEST(RayMethods, answer_an_unknown_name_with_the_known_ones) {
  const auto found = find_ray_method("bresenham");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::kUsage);
  EXPECT_EQ(found.error().remedy, "known are: voxel_traversal, line_drawing");
}

}  // namespace
}  // namespace swiftlet
