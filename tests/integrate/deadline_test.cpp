// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What integrate.max_frame_ms does to a frame: whole blocks are left out, and counted.

#include <gtest/gtest.h>

#include <chrono>
#include <map>

#include "support/synthetic.hpp"
#include "swiftlet/integrate/integrator.hpp"
#include "swiftlet/integrate/measurement_models.hpp"
#include "swiftlet/preprocess/preprocessor.hpp"

namespace swiftlet {
namespace {

using KnownBlocks = std::map<BlockIndex, VoxelBlock>;

/// One frame of random relief, fused into an empty map within a limit.
class LimitedFrame {
 public:
  explicit LimitedFrame(test::Random& random)
      : frame_(test::random_frame(random, test::small_camera(320, 240))),
        preprocessor_(*Preprocessor::create({.downsample = 1})),
        depth_(preprocessor_.clean(frame_.depth, frame_.intrinsics, 0.004)) {
    pyramid_.build(depth_.raw);
  }

  IntegrationTally fuse(double max_frame_ms, KnownBlocks& blocks) const {
    auto map = RollingMap::create({.voxel_m = 0.05, .size_m = {8, 8, 8}});
    map->recentre(Eigen::Vector3d::Zero(), nullptr);
    const auto integrator =
        *make_integrator({.integrator = "projective", .max_frame_ms = max_frame_ms});
    const DepthView view{depth_, pyramid_, frame_.intrinsics, frame_.T_world_camera, 0};
    const StereoSensor sensor(frame_.intrinsics, {}, 0.05, 1);
    const IntegrationTally tally = integrator->integrate(view, sensor, *model_, *map);
    map->for_each_known_block([&](const BlockIndex& i, const VoxelBlock& b) { blocks[i] = b; });
    return tally;
  }

 private:
  Frame frame_;
  Preprocessor preprocessor_;
  const PreprocessedDepth& depth_;
  DepthRangePyramid pyramid_;
  // One for all, so that its table is filled once and not within the limit.
  MeasurementModelPtr model_ = find_measurement_model("inverse_sensor_model")->make();
};

// A limit that is over before the first block: nothing is fused, and what is left is counted.
TEST(Deadline, counts_the_blocks_that_it_leaves_out) {
  test::Random random;
  const LimitedFrame frame(random);
  KnownBlocks all, none;
  const IntegrationTally whole = frame.fuse(0.0, all);
  EXPECT_GT(whole.blocks, 100U);
  EXPECT_EQ(whole.blocks_left, 0U);
  const IntegrationTally late = frame.fuse(1e-6, none);
  EXPECT_EQ(late.blocks, 0U);
  EXPECT_GE(late.blocks_left, whole.blocks);
  EXPECT_TRUE(none.empty());
}

// Wherever the limit falls: each block has all evidence of the frame or none of it.
TEST(Deadline, never_gives_a_block_half_of_a_frame) {
  test::Random random;
  const LimitedFrame frame(random);
  KnownBlocks all;
  frame.fuse(0.0, all);  // fills the table
  const auto start = std::chrono::steady_clock::now();
  const IntegrationTally whole = frame.fuse(0.0, all);
  const std::chrono::duration<double, std::milli> whole_ms =
      std::chrono::steady_clock::now() - start;
  int parted = 0;
  constexpr int kLimits = 80;
  for (int i = 1; i <= kLimits && parted < 5; ++i) {
    const double limit_ms = i * whole_ms.count() / kLimits;
    KnownBlocks some;
    const IntegrationTally tally = frame.fuse(limit_ms, some);
    EXPECT_EQ(tally.blocks, some.size());
    for (const auto& [index, block] : some) ASSERT_TRUE(all.at(index) == block) << limit_ms;
    parted += tally.blocks > 0 && tally.blocks < whole.blocks ? 1 : 0;
    EXPECT_TRUE(tally.blocks == whole.blocks || tally.blocks_left > 0);
  }
  EXPECT_GT(parted, 0) << "no limit parted the frame: there is nothing to see here";
}

}  // namespace
}  // namespace swiftlet
