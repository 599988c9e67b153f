// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/map/occupancy_map.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/occupancy_map_laws.hpp"
#include "swiftlet/map/memory_archive.hpp"
#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet {
namespace {

static_assert(OccupancyMap<RollingMap> && OccupancyMap<MapSnapshot> && OccupancyMap<BlockMap>);

/// The model as the live map holds it.
RollingMap live_map_of(const test::MapModel& model) {
  auto map = RollingMap::create({model.voxel_m, {4.0, 3.0, 2.0}, {0.5, 0.5, 0.5}}, model.scale);
  map->recentre({0.3, -0.2, 0.1}, nullptr);
  for (const auto& [v, voxel] : model.voxels)
    map->writable(block_of(v)).voxels[offset_in_block(v)] = voxel;
  return std::move(*map);
}

TEST(OccupancyMap, live_map_snapshot_and_copy_in_memory_answer_alike) {
  test::for_each_seed(10, [](test::Random& random) {
    const VoxelBox box{{-14, -15, -8}, {18, 10, 9}};
    const test::MapModel model = test::random_model(random, box);
    RollingMap live = live_map_of(model);
    ASSERT_TRUE(live.window().contains(block_of(box.first)));
    ASSERT_TRUE(live.window().contains(block_of(box.last)));
    test::expect_answers_of(model, live, box, random);
    const auto snapshot = live.snapshot({1});
    ASSERT_TRUE(snapshot);
    test::expect_answers_of(model, *snapshot, box, random);
    test::expect_answers_of(model, copy_blocks(*snapshot), box, random);
    test::expect_answers_of(model, test::block_map_of(model), box, random);
  });
}

TEST(OccupancyMap, a_place_that_is_none_is_unknown) {
  BlockMap map;
  map.set({}, kOccupiedVoxel);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double odd : {nan, 1e300, -1e300, 4.3e8, std::numeric_limits<double>::infinity()}) {
    EXPECT_EQ(map.occupancy(Eigen::Vector3d(0.1, odd, 0.1)), Occupancy::kUnknown) << odd;
    EXPECT_EQ(map.probability(Eigen::Vector3d(odd, 0.1, 0.1)), 0.5) << odd;
  }
  EXPECT_EQ(map.occupancy(Eigen::Vector3d(0.1, 0.1, 0.1)), Occupancy::kOccupied);
}

TEST(MapSnapshot, tells_its_age_its_pose_and_how_its_voxels_are_read) {
  auto map = RollingMap::create({0.1, {4.0, 3.0, 2.0}, {0.5, 0.5, 0.5}}, {{50, 250}, 0.1});
  ASSERT_TRUE(map);
  map->recentre(Eigen::Vector3d::Zero(), nullptr);
  map->writable({0, 0, 0}).voxels[0] = 240;
  const auto at = Transform<World, Camera>::trusted(Eigen::Quaterniond::Identity(), {1, 2, 3});
  const auto first = map->snapshot({7, Stamp{123'456}, at});
  const auto second = map->snapshot({8, Stamp{123'500}, {}});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->frame_count(), 7U);
  EXPECT_EQ(first->stamp(), Stamp{123'456});
  EXPECT_EQ(first->T_world_camera().translation(), at.translation());
  EXPECT_EQ(second->stamp(), Stamp{123'500});
  EXPECT_EQ(first->thresholds().occupied_from, 250);
  EXPECT_EQ(first->occupancy(VoxelIndex{0, 0, 0}), Occupancy::kUnknown) << "by these thresholds";
  EXPECT_DOUBLE_EQ(first->probability(VoxelIndex{0, 0, 0}), 1.0 / (1.0 + std::exp(-11.3)));
}

TEST(BlockMap, holds_blocks_as_far_apart_as_an_index_reaches) {
  constexpr std::int32_t kLast = (1 << 28) - 1;
  BlockMap map;
  EXPECT_TRUE(map.extent().is_empty());
  EXPECT_FALSE(summarize(map).bounds);
  map.put({-kLast, 0, kLast}, {});
  map.put({kLast, 0, -kLast}, {});
  EXPECT_EQ(map.extent(), (BlockWindow{{-kLast, 0, -kLast}, {2 * kLast + 1, 1, 2 * kLast + 1}}));
  EXPECT_EQ(voxel_box(map.extent()).last.x, std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(map.sorted_blocks(), (std::vector<BlockIndex>{{kLast, 0, -kLast}, {-kLast, 0, kLast}}));
  EXPECT_TRUE(map.erase({kLast, 0, -kLast}));
  EXPECT_FALSE(map.erase({kLast, 0, -kLast}));
  EXPECT_EQ(map.block_count(), 1U);
  map.clear();
  EXPECT_TRUE(map.extent().is_empty());
}

TEST(CopyBox, refuses_a_buffer_that_is_too_small) {
  const BlockMap map;
  std::vector<QuantizedLogOdds> buffer(7);
  EXPECT_DEATH(copy_box(map, {{0, 0, 0}, {1, 1, 1}}, std::span<QuantizedLogOdds>(buffer)), "room");
}

TEST(VoxelBox, counts_its_voxels_however_many) {
  EXPECT_EQ((VoxelBox{{0, 0, 0}, {0, 0, 0}}).voxel_count(), 1U);
  EXPECT_EQ((VoxelBox{{-1, 2, 3}, {1, 5, 3}}).voxel_count(), 12U);
  constexpr std::int32_t kFar = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ((VoxelBox{{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}}).voxel_count(),
            std::numeric_limits<std::size_t>::max());
  const VoxelBox box = voxel_box_between({-0.05, 0.0, 0.05}, {0.05, 0.1, 0.05}, 0.1);
  EXPECT_EQ(box.first, (VoxelIndex{-1, 0, 0}));
  EXPECT_EQ(box.last, (VoxelIndex{0, 1, 0}));
}

}  // namespace
}  // namespace swiftlet
