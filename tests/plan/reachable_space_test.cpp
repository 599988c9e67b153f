// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/plan/reachable_space.hpp"

#include <gtest/gtest.h>

#include <map>
#include <queue>

#include "plan/plan_support.hpp"

namespace swiftlet {
namespace {

using test::Clutter;
using test::Random;

/// Dijkstra's way, as the textbook has it. [tenths of a voxel]
std::map<VoxelIndex, int> costs_by_hand(const DistanceField& field, const VoxelIndex& from,
                                        double least_m) {
  using Entry = std::pair<int, VoxelIndex>;
  std::map<VoxelIndex, int> cost{{from, 0}};
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  queue.push({0, from});
  while (!queue.empty()) {
    const auto [so_far, v] = queue.top();
    queue.pop();
    if (so_far > cost[v]) continue;
    for (int step = 0; step < 27; ++step) {
      const VoxelIndex d{step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1};
      const int axes = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
      if (axes != 1 && axes != 2) continue;
      const VoxelIndex to{v.x + d.x, v.y + d.y, v.z + d.z};
      if (!field.contains(to) || field.distance(to, Obstacles::kNotFree).distance_m < least_m)
        continue;
      const int next = so_far + (axes == 1 ? 10 : 14);
      const auto known = cost.find(to);
      if (known != cost.end() && known->second <= next) continue;
      cost[to] = next;
      queue.push({next, to});
    }
  }
  return cost;
}

TEST(ReachableSpace, is_what_a_search_by_the_textbook_reaches_at_the_same_cost) {
  ReachableSpace space;  // kept: a second flood knows nothing of the first
  test::for_each_seed(10, [&](Random& random) {
    Clutter clutter(random);
    const auto map = clutter.made().snapshot();
    const auto field = test::field_of(map);
    const double least_m = random.real(0.05, 0.35);
    space.flood(field, Obstacles::kNotFree, Clutter::kFrom, least_m);
    const auto by_hand =
        costs_by_hand(field, voxel_containing(Clutter::kFrom, map.voxel_m()), least_m);
    EXPECT_EQ(space.voxel_count(), by_hand.size());
    for (const auto& [v, cost] : by_hand) {
      ASSERT_TRUE(space.path_m(v));
      EXPECT_NEAR(*space.path_m(v), 0.1 * cost * map.voxel_m(), 1e-9);
    }
  });
}

TEST(ReachableSpace, is_empty_from_outside_and_before_the_first_flood) {
  ReachableSpace space;
  EXPECT_FALSE(space.path_m(Eigen::Vector3d::Zero().eval()));
  test::HandMadeMap made(0.1, {2, 2, 2});
  made.fill_window(test::kFree);
  const auto map = made.snapshot();
  space.flood(test::field_of(map), Obstacles::kNotFree, {50, 0, 0}, 0.1);
  EXPECT_EQ(space.voxel_count(), 0U);
  EXPECT_FALSE(space.path_m(Eigen::Vector3d::Zero().eval()));
}

}  // namespace
}  // namespace swiftlet
