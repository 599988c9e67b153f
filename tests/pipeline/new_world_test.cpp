// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include <map>

#include "support/synthetic.hpp"
#include "swiftlet/pipeline/mapper.hpp"

namespace swiftlet {
namespace {

using Voxels = std::map<BlockIndex, VoxelBlock>;

Voxels voxels_of(const Mapper& mapper) {
  Voxels voxels;
  mapper.map().for_each_known_block(
      [&](const BlockIndex& index, const VoxelBlock& block) { voxels.emplace(index, block); });
  return voxels;
}

Mapper mapper_with(NewWorldRule rule) {
  MapperConfig config;
  config.on_new_world = rule;
  config.quality = {0.0, 1.0, 1.0, 1.0, 0};  // takes random images, too
  return *Mapper::create(config);
}

Frame seen_in(std::uint32_t epoch, double wall_m) {
  Frame frame = test::wall_frame(test::small_camera(), wall_m);
  frame.pose_epoch = epoch;
  return frame;
}

/// The map of these frames and no others.
Voxels map_of(const std::vector<Frame>& frames) {
  Mapper mapper = mapper_with(NewWorldRule::kRefuse);
  for (const Frame& frame : frames) {
    EXPECT_EQ(mapper.integrate(frame).verdict, FrameVerdict::kIntegrated);
  }
  return voxels_of(mapper);
}

TEST(NewWorld, is_never_fused_into_the_map_of_the_old_one_unless_that_is_asked_for) {
  const std::vector<Frame> old_world{seen_in(4, 2.0), seen_in(4, 2.1)};
  const std::vector<Frame> new_world{seen_in(5, 3.0), seen_in(5, 3.1)};
  Mapper mapper = mapper_with(MapperConfig{}.on_new_world);
  for (const Frame& frame : old_world) mapper.integrate(frame);
  for (const Frame& frame : new_world) {
    EXPECT_EQ(mapper.integrate(frame).verdict, FrameVerdict::kOtherWorld);
  }
  EXPECT_EQ(voxels_of(mapper), map_of(old_world)) << "refused frames leave no trace";

  Mapper keeper = mapper_with(NewWorldRule::kKeep);
  for (const auto& frames : {old_world, new_world}) {
    for (const Frame& frame : frames) keeper.integrate(frame);
  }
  EXPECT_EQ(keeper.frame_count(), 4U);
  EXPECT_NE(voxels_of(keeper), map_of(old_world));
}

TEST(NewWorld, begins_with_the_bits_of_a_new_mapper_and_its_readers_follow) {
  test::for_each_seed(20, [](test::Random& random) {
    std::vector<Frame> old_world, new_world;
    for (int i = 0; i < 6; ++i) {
      old_world.push_back(test::random_frame(random, test::small_camera(), 3.0));
      new_world.push_back(test::random_frame(random, test::small_camera(), 3.0));
      new_world.back().pose_epoch = 1;
    }
    for (const NewWorldRule rule : {NewWorldRule::kRefuse, NewWorldRule::kClear}) {
      Mapper mapper = mapper_with(rule);
      const MapReader reader = mapper.reader();
      for (const Frame& frame : old_world) mapper.integrate(frame);
      const auto held = reader.latest();
      if (rule == NewWorldRule::kRefuse) mapper.begin_world(1);
      for (const Frame& frame : new_world) mapper.integrate(frame);
      EXPECT_EQ(voxels_of(mapper), map_of(new_world)) << name_of(rule) << random.repeat();
      EXPECT_EQ(reader.latest()->frame_count(), new_world.size());
      EXPECT_EQ(held->frame_count(), old_world.size()) << "a held snapshot never changes";
    }
  });
}

TEST(NewWorld, is_not_cleared_by_frames_that_come_late_or_are_of_no_use) {
  Mapper mapper = mapper_with(NewWorldRule::kClear);
  mapper.integrate(seen_in(7, 2.0));
  const Voxels before = voxels_of(mapper);
  EXPECT_EQ(mapper.integrate(seen_in(6, 3.0)).verdict, FrameVerdict::kOtherWorld) << "late";
  EXPECT_EQ(mapper.integrate(seen_in(8, 0.0)).verdict, FrameVerdict::kNoReadings);
  EXPECT_EQ(voxels_of(mapper), before);
  EXPECT_EQ(mapper.integrate(seen_in(8, 3.0)).verdict, FrameVerdict::kIntegrated);
  EXPECT_EQ(mapper.frame_count(), 1U);
}

class NoArchive final : public BlockArchive {
  void evict(const BlockIndex&, const VoxelBlock&, std::uint64_t) override {}
  bool restore(const BlockIndex&, VoxelBlock&) override { return false; }
  void expect_around(const BlockWindow&) override {}
};

TEST(NewWorld, is_no_setting_that_could_bring_the_old_one_back) {
  MapperConfig config;
  config.on_new_world = static_cast<NewWorldRule>(3);
  ASSERT_EQ(config.faults().size(), 1U);
  EXPECT_EQ(config.faults().front().where, "map.on_new_world");
  config.on_new_world = NewWorldRule::kClear;
  EXPECT_TRUE(Mapper::create(config));
  NoArchive archive;
  EXPECT_FALSE(Mapper::create(config, &archive)) << "the archive still holds the old world";
}

}  // namespace
}  // namespace swiftlet
