// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/app/mapping_session.hpp"

#include <gtest/gtest.h>

#include "support/temp_folder.hpp"
#include "swiftlet/store/saved_map.hpp"

namespace swiftlet::app {
namespace {

/// A wall 1 m ahead of a camera that stands at `x_m` and looks along x.
Frame wall_seen_from(double x_m, std::uint32_t epoch, int number) {
  Frame frame{
      Stamp{33'000'000LL * number}, DepthImage{Image<std::uint16_t>(24, 16, 1000)},
      PinholeIntrinsics::create(24, 16, 20, 20, 11.5, 7.5).value(),
      Transform<World, Camera>::trusted(forward_looking_camera().rotation(), {x_m, 0.0, 0.0})};
  frame.pose_epoch = epoch;
  return frame;
}

struct Saved {
  double min_x_m = 1e9, max_x_m = -1e9;  // of all blocks
  std::uint64_t frames = 0;
};

/// Maps the frames into a file and reads it back.
Saved map(const std::vector<Frame>& frames, std::size_t expected_restarts) {
  const test::TempFolder folder;
  MapperConfig config;
  config.depth.downsample = 1;
  config.quality.max_frozen = 0;  // one image, seen from everywhere
  SessionOptions options;
  options.path = (folder / "map.swl").string();
  auto session = MappingSession::create(config, options);
  EXPECT_TRUE(session);
  for (const Frame& frame : frames) {
    const auto done = (*session)->integrate(frame);
    EXPECT_TRUE(done) << done.error().text();
  }
  EXPECT_EQ((*session)->summary().restarts, expected_restarts);
  EXPECT_EQ((*session)->summary().integrated(), frames.size());
  const auto saved = (*session)->save();
  EXPECT_TRUE(saved) << saved.error().text();

  Saved result;
  const auto file = load_map(options.path);
  EXPECT_TRUE(file);
  result.frames = file->frames();
  EXPECT_TRUE(file->for_each_block([&](const BlockIndex& i, const VoxelBlock&) -> Status {
    result.min_x_m = std::min(result.min_x_m, 8 * i.x * file->voxel_m());
    result.max_x_m = std::max(result.max_x_m, 8 * (i.x + 1) * file->voxel_m());
    return Done{};
  }));
  return result;
}

TEST(MappingSession, begins_the_map_and_its_file_anew_when_the_poses_lose_their_place) {
  std::vector<Frame> frames;
  for (int i = 0; i < 5; ++i) frames.push_back(wall_seen_from(0.0, 0, i));
  for (int i = 5; i < 9; ++i) frames.push_back(wall_seen_from(100.0, 1, i));
  const Saved restarted = map(frames, 1);
  EXPECT_EQ(restarted.frames, 4U) << "those of the new epoch";
  EXPECT_GT(restarted.min_x_m, 90.0) << "nothing of the old world is left";

  for (Frame& frame : frames) frame.pose_epoch = 0;
  const Saved kept = map(frames, 0);
  EXPECT_EQ(kept.frames, 9U);
  EXPECT_LT(kept.min_x_m, 1.0) << "or the test shows nothing";
  EXPECT_GT(kept.max_x_m, 100.0);
}

}  // namespace
}  // namespace swiftlet::app
