// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

#include "app/support/run_program.hpp"
#include "support/recordings.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet::test {
namespace {

using ::testing::HasSubstr;

/// Three thousand frames: a flight so long that the program is surely under way when something
/// comes in between. With fine pixels and voxels they take seconds, the first a millisecond.
class LongFlight : public ::testing::Test {
 protected:
  static constexpr int kFrames = 3000;

  void SetUp() override {
    std::filesystem::create_directory(folder_ / "rec");
    write_file(folder_ / "rec/camera-intrinsics.txt", kSmallCamera);
    write_seven_scenes_frame(folder_ / "rec", 0);
    for (int number = 1; number < kFrames; ++number) {
      for (const char* kind : {"depth.png", "pose.txt"}) {
        std::filesystem::create_hard_link(
            folder_ / fmt::format("rec/frame-000000.{}", kind),
            folder_ / fmt::format("rec/frame-{:06}.{}", number, kind));
      }
    }
  }
  static std::vector<std::string> flight(int frames = kFrames) {
    return {"map",   "7scenes:rec",        "-o",       "a.swl",
            "--set", "depth.downsample=1", "--frames", std::to_string(frames),
            "--set", "map.voxel_m=0.02"};
  }
  /// The map is one single file, good, and whole as far as the flight went.
  void expect_saved(std::uint64_t least, std::uint64_t most) const {
    EXPECT_EQ(run({"check", "a.swl"}, folder_.path()).exit_code, 0);
    const auto map = load_map(folder_ / "a.swl");
    ASSERT_TRUE(map) << map.error().text();
    EXPECT_GE(map->frames(), least);
    EXPECT_LE(map->frames(), most);
    EXPECT_EQ(map->meta().at("flight"), "saved");
    EXPECT_FALSE(std::filesystem::exists(folder_ / "a.swl-wal")) << "one single file";
  }

  TempFolder folder_;
};

class Interrupt : public LongFlight, public ::testing::WithParamInterface<int> {};

TEST_P(Interrupt, stops_the_flight_and_saves_what_was_mapped) {
  RunningProgram program(flight(), folder_.path());
  ASSERT_TRUE(program.wait_for_file("a.swl"));
  program.send(GetParam());
  // A terminal that goes sends one, and so does its shell.
  if (GetParam() == SIGHUP) program.send(SIGHUP);
  const Ended ended = program.wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_THAT(ended.out, HasSubstr("interrupted; saved"));
  expect_saved(1, kFrames - 1);
}

INSTANTIATE_TEST_SUITE_P(, Interrupt, ::testing::Values(SIGINT, SIGTERM, SIGHUP),
                         [](const auto& s) {
                           return s.param == SIGINT    ? "ctrl_c"
                                  : s.param == SIGTERM ? "sigterm"
                                                       : "sighup";
                         });

TEST_F(LongFlight, is_saved_though_nobody_reads_its_output) {
  std::string words = "'" SWIFTLET_PROGRAM "'";
  for (const std::string& word : flight(20)) words += " '" + word + "'";
  const std::string line =
      "cd '" + folder_.path().string() + "' && { { " + words + "; echo $? > code; } 2>&1 | true; }";
  ASSERT_EQ(std::system(line.c_str()), 0) << line;
  EXPECT_EQ(content_of(folder_ / "code"), "1\n") << "standard output could not be written";
  expect_saved(20, 20);
}

TEST_F(LongFlight, is_not_killed_by_a_file_that_reaches_its_limit) {
  for (std::uint64_t limit = 1024; limit <= 262'144; limit *= 2) {
    std::filesystem::remove(folder_ / "a.swl");  // saved in part, by the run before
    const Ended ended = run(flight(20), folder_.path(), limit);
    EXPECT_TRUE(ended.exit_code == 0 || ended.exit_code == 1) << ended.exit_code << ended.err;
    if (ended.exit_code == 0) break;
    EXPECT_THAT(ended.err, HasSubstr("a.swl"));
  }
}

}  // namespace
}  // namespace swiftlet::test
