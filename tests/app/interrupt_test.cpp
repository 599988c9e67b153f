// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "app/support/run_program.hpp"
#include "support/recordings.hpp"
#include "swiftlet/store/saved_map.hpp"

namespace swiftlet::test {
namespace {

using ::testing::HasSubstr;

class Interrupt : public ::testing::TestWithParam<int> {};

/// A flight so long that the program is surely under way when the signal comes.
TEST_P(Interrupt, stops_the_flight_and_saves_what_was_mapped) {
  const TempFolder folder;
  std::filesystem::create_directory(folder / "rec");
  write_file(folder / "rec/camera-intrinsics.txt", kSmallCamera);
  constexpr int kFrames = 3000;
  write_seven_scenes_frame(folder / "rec", 0);
  for (int number = 1; number < kFrames; ++number) {
    for (const char* kind : {"depth.png", "pose.txt"}) {
      std::filesystem::create_hard_link(folder / fmt::format("rec/frame-000000.{}", kind),
                                        folder / fmt::format("rec/frame-{:06}.{}", number, kind));
    }
  }
  // Fine pixels and cells: three thousand frames take seconds, the first a millisecond.
  RunningProgram program({"map", "7scenes:rec", "-o", "a.swl", "--set", "depth.downsample=1",
                          "--set", "map.voxel_m=0.02"},
                         folder.path());
  ASSERT_TRUE(program.wait_for_file("a.swl"));
  program.send(GetParam());
  const Ended ended = program.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("interrupted; saved"));
  EXPECT_EQ(run({"check", "a.swl"}, folder.path()).exit_code, 0);
  const auto map = load_map(folder / "a.swl");
  ASSERT_TRUE(map) << map.error().text();
  EXPECT_GE(map->frames(), 1U);
  EXPECT_LT(map->frames(), static_cast<std::uint64_t>(kFrames));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.swl-wal")) << "one single file";
}

INSTANTIATE_TEST_SUITE_P(, Interrupt, ::testing::Values(SIGINT, SIGTERM),
                         [](const auto& s) { return s.param == SIGINT ? "ctrl_c" : "sigterm"; });

}  // namespace
}  // namespace swiftlet::test
