// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The projective integrator's promise: the same map bits on any machine and any number of threads.

#include <gtest/gtest.h>

#include "support/every_instruction_set.hpp"
#include "support/synthetic.hpp"
#include "swiftlet/condition/conditioner.hpp"
#include "swiftlet/integrate/integrator.hpp"

namespace swiftlet {
namespace {

/// All blocks after a few frames of random relief.
std::vector<VoxelBlock> mapped(std::uint64_t seed, CellShape shape, int threads = 1) {
  test::Random random(seed);
  auto map =
      RollingMap::create({.voxel_m = 0.1, .size_m = {8, 8, 8}, .trigger_m = {1e3, 1e3, 1e3}});
  map->recentre(Eigen::Vector3d::Zero(), nullptr);
  const auto integrator = *make_integrator({.integrator = "projective", .threads = threads});
  auto conditioner =
      Conditioner::create({.steps = {"range_gate", "smooth", "near_downsample"}, .downsample = 1});
  DepthRangePyramid pyramid;
  for (std::uint64_t i = 0; i < 4; ++i) {
    const Frame frame = test::random_frame(random, test::small_camera(163, 121));
    const ConditionedDepth& depth = conditioner->clean(frame.depth, frame.intrinsics, 0.004);
    const StereoSensor sensor(frame.intrinsics, {}, map->voxel_m(), 1, shape);
    pyramid.build(depth.raw);
    integrator->integrate({depth, pyramid, frame.intrinsics, frame.T_world_camera, i}, sensor,
                          *map);
  }
  std::vector<VoxelBlock> blocks;
  map->for_each_known_block(
      [&](const BlockIndex&, const VoxelBlock& block) { blocks.push_back(block); });
  return blocks;
}

/// With what sharp fusion does before: it has kernels of its own.
class ProjectiveBits : public testing::TestWithParam<CellShape> {};

TEST_P(ProjectiveBits, are_the_same_on_every_instruction_set_of_this_machine) {
  const std::vector<VoxelBlock> widest = mapped(3, GetParam());
  ASSERT_GT(widest.size(), 50U);
  const int targets = test::on_every_instruction_set(
      [&](const char* name) { EXPECT_TRUE(mapped(3, GetParam()) == widest) << name; });
  EXPECT_GE(targets, 1);
}

TEST_P(ProjectiveBits, are_the_same_on_any_number_of_threads) {
  const std::vector<VoxelBlock> alone = mapped(5, GetParam());
  for (const int threads : {2, 3, 4})
    EXPECT_TRUE(mapped(5, GetParam(), threads) == alone) << threads;
}

INSTANTIATE_TEST_SUITE_P(Shapes, ProjectiveBits,
                         testing::Values(CellShape::kSlice, CellShape::kChord),
                         [](const auto& test) {
                           return test.param == CellShape::kSlice ? "slices" : "chords";
                         });

// A limit that is over before the first cube: nothing is fused, and what is left is counted.
TEST(Projective, counts_the_blocks_that_a_deadline_leaves) {
  test::Random random;
  const Frame frame = test::random_frame(random, test::small_camera());
  auto conditioner = Conditioner::create({.downsample = 1});
  const ConditionedDepth& depth = conditioner->clean(frame.depth, frame.intrinsics, 0.004);
  DepthRangePyramid pyramid;
  pyramid.build(depth.raw);
  const DepthView view{depth, pyramid, frame.intrinsics, frame.T_world_camera, 0};
  const StereoSensor sensor(frame.intrinsics, {}, 0.1, 1);
  const auto blocks_of = [&](double max_frame_ms) {
    auto map = RollingMap::create({.voxel_m = 0.1, .size_m = {8, 8, 8}});
    map->recentre(Eigen::Vector3d::Zero(), nullptr);
    const auto integrator =
        *make_integrator({.integrator = "projective", .max_frame_ms = max_frame_ms});
    const auto tally = integrator->integrate(view, sensor, *map);
    return std::pair(tally.blocks, tally.blocks_left);
  };
  const auto [all, none_left] = blocks_of(0.0);
  EXPECT_GT(all, 10U);
  EXPECT_EQ(none_left, 0U);
  const auto [none, left] = blocks_of(1e-6);
  EXPECT_EQ(none, 0U);
  EXPECT_GE(left, all);
}

}  // namespace
}  // namespace swiftlet
