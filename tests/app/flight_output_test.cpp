// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// The built program and the files that are the user's own: none is lost, whatever he types and
// whatever the disk does.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/support/program_fixture.hpp"
#include "app/support/run_program.hpp"
#include "support/recordings.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/store/map_file/save_map.hpp"

namespace swiftlet::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class FlightOutput : public ProgramFixture {};

TEST_F(FlightOutput, of_a_flight_that_was_cut_off_is_told_so_by_info) {
  BlockMap map({0.1, {}, 1});
  map.set({}, kUnknownVoxel);
  for (const std::string flight : {"under way", "saved"}) {
    ASSERT_TRUE(save_map(folder_ / (flight + ".swl"), map, {{"flight", flight}}));
  }
  const Ended cut = swiftlet({"info", "under way.swl"});
  EXPECT_THAT(cut.out, HasSubstr("the flight was cut off"));
  EXPECT_THAT(cut.out, HasSubstr("under way.swl-wal, it is not here"))
      << "what it held may be lost";
  EXPECT_THAT(swiftlet({"info", "saved.swl"}).out, Not(HasSubstr("cut off")));
}

TEST_F(FlightOutput, overwrite_keeps_the_old_map_until_the_new_one_is_saved) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  write_file(folder_ / "a.swl.bak", "the user's own");
  const std::string before = content_of(folder_ / "a.swl");
  const auto is_kept = [&](const std::string& name) {
    return content_of(folder_ / name) == before;
  };
  // Too small for any map, for the first batch, for the last one: a disk that fills sooner or
  // later.
  for (const std::uint64_t limit : {1U, 8192U, 16384U, 24576U, 32768U}) {
    const Ended ended =
        run({"map", "7scenes:rec", "-o", "a.swl", "--overwrite"}, folder_.path(), limit);
    if (ended.exit_code == 0) break;
    EXPECT_EQ(std::ranges::count_if(left_behind("a."), is_kept), 1) << limit << ended.err;
  }
  // The same command as often as one likes, whatever the ones before have left.
  ASSERT_EQ(map_to("a.swl", {"--overwrite"}).exit_code, 0);
  ASSERT_EQ(map_to("a.swl", {"--overwrite"}).exit_code, 0);
  EXPECT_EQ(content_of(folder_ / "a.swl.bak"), "the user's own");
  for (const std::string& name : left_behind("a.swl")) {
    EXPECT_TRUE(name == "a.swl" || name == "a.swl.bak") << name;
  }
}

TEST_F(FlightOutput, overwrite_replaces_maps_and_nothing_else) {
  write_file(folder_ / "notes.txt", "dear diary");
  write_file(folder_ / "flight.bag", "#ROSBAG V2.0\n");
  expect_refusal(map_to("notes.txt", {"--overwrite"}), 2, "the file is no Swiftlet map");
  expect_refusal(map_to("rec", {"--overwrite"}), 2, "it exists and is not a file");
  EXPECT_EQ(content_of(folder_ / "notes.txt"), "dear diary");
}

TEST_F(FlightOutput, puts_the_time_of_the_start_into_the_name_of_the_map) {
  ASSERT_EQ(map_to("a-%t.swl").exit_code, 0);
  EXPECT_THAT(left_behind("a-"),
              ::testing::ElementsAre(::testing::MatchesRegex("a-....-..-..T..-..-..[.]swl")));
}

#if SWIFTLET_HAS_EMBREE
TEST_F(FlightOutput, writes_the_flight_as_mcap_which_gives_the_same_map) {
  const Ended first = swiftlet(
      {"map", "sim:wall", "--frames", "3", "--json", "-o", "a.swl", "--mcap", "flight.mcap"});
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_THAT(swiftlet({"info", "flight.mcap"}).out,
              AllOf(HasSubstr("MCAP, profile ros2"), HasSubstr("/map/occupied"),
                    HasSubstr("would map: depth from /camera/depth/image_rect_raw")));
  const Ended second = swiftlet({"map", "bag:flight.mcap", "--json", "-o", "b.swl"});
  ASSERT_EQ(second.exit_code, 0) << second.err;
  const auto a = nlohmann::json::parse(first.out), b = nlohmann::json::parse(second.out);
  EXPECT_EQ(b.at("frames"), a.at("frames"));
  EXPECT_EQ(b.at("voxels"), a.at("voxels"));
}
#endif

TEST_F(FlightOutput, the_flight_as_mcap_replaces_no_file_unasked) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  write_file(folder_ / "old.mcap", "an older flight");
  expect_refusal(map_to("b.swl", {"--mcap", "old.mcap"}), 2, "old.mcap: the file exists");
  expect_refusal(map_to("b.swl", {"--mcap", "./b.swl"}), 2, "the file of the map");
  expect_refusal(map_to("b.swl", {"--overwrite", "--mcap", "a.swl"}), 2, "a Swiftlet map");
  EXPECT_EQ(content_of(folder_ / "old.mcap"), "an older flight");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.swl"));
  EXPECT_EQ(map_to("b.swl", {"--overwrite", "--mcap", "old.mcap"}).exit_code, 0);
  EXPECT_THAT(content_of(folder_ / "old.mcap"), HasSubstr("MCAP"));
}

TEST_F(FlightOutput, flies_on_when_a_real_disk_is_full_and_ends_with_a_clear_sentence) {
  const std::filesystem::path disk = folder_ / "disk";
  std::filesystem::create_directory(disk);
  const std::string place = "'" + disk.string() + "'";
  if (std::system(("mount -t tmpfs -o size=128k none " + place + " 2> /dev/null").c_str()) != 0)
    GTEST_SKIP() << "this system lets nobody mount a small disk (tmpfs)";
  const Ended ended = map_to("disk/a.swl", {"--set", "depth.downsample=1", "--set",
                                            "map.voxel_m=0.02", "--set", "map.size_m=[8,8,4]"});
  EXPECT_EQ(ended.exit_code, 1);
  EXPECT_THAT(ended.err, HasSubstr("disk/a.swl"));
  EXPECT_THAT(ended.out, HasSubstr("frames     3 in")) << "all of them";
  EXPECT_EQ(std::system(("mount -o remount,size=4m " + place).c_str()), 0);  // room is made
  const Ended told = swiftlet({"info", "disk/a.swl"});
  EXPECT_EQ(std::system(("umount " + place).c_str()), 0);
  EXPECT_EQ(told.exit_code, 0) << told.err;
}

TEST_F(FlightOutput, a_disk_that_is_full_at_the_start_is_told_before_the_flight) {
  const std::filesystem::path disk = folder_ / "disk";
  std::filesystem::create_directory(disk);
  const std::string place = "'" + disk.string() + "'";
  if (std::system(("mount -t tmpfs -o size=64k none " + place + " 2> /dev/null").c_str()) != 0)
    GTEST_SKIP() << "this system lets nobody mount a small disk (tmpfs)";
  const Ended little = map_to("disk/a.swl");
  write_file(disk / "much", std::string(64U << 10U, 'x'));
  const Ended none = map_to("disk/a.swl");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(disk), {}), 1) << "much";
  EXPECT_EQ(std::system(("umount " + place).c_str()), 0);
  expect_refusal(little, 1, "kB left, too little to begin a map");
  expect_refusal(none, 1, "disk/a.swl: there is no space left");
  EXPECT_THAT(none.err, Not(HasSubstr("frames"))) << "none was read";
}

TEST_F(FlightOutput, an_output_is_never_its_input_nor_a_map_whatever_it_is_called) {
  namespace fs = std::filesystem;
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  const std::string before = content_of(folder_ / "a.swl");
  fs::create_symlink("a.swl", folder_ / "link.png");
  fs::create_hard_link(folder_ / "a.swl", folder_ / "twin.png");
  fs::copy_file(folder_ / "a.swl", folder_ / "other.swl");
  for (const std::string out : {"a.swl", "./a.swl", "link.png", "twin.png"}) {
    expect_refusal(swiftlet({"render", "a.swl", "-o", out}), 2, "this is the input a.swl");
    expect_refusal(swiftlet({"export", "a.swl", "--to", "ply", "-o", out}), 2, "the input a.swl");
    EXPECT_EQ(content_of(folder_ / out), before) << out;
  }
  expect_refusal(swiftlet({"render", "a.swl", "-o", "other.swl"}), 2, "other.swl: this is a Swift");
  expect_refusal(swiftlet({"export", "a.swl", "--to", "pcd", "-o", "other.swl"}), 2,
                 "a Swiftlet map");
  expect_refusal(swiftlet({"render", "a.swl", "-o", "/dev/null"}), 2, "is not a file");
  write_file(folder_ / "wall.bag", "#ROSBAG V2.0\n");
  expect_refusal(
      swiftlet({"calibrate", "distortion", "bag:wall.bag?pairing=nearest", "-o", "wall.bag"}), 2,
      "this is the input wall.bag");
}

}  // namespace
}  // namespace swiftlet::test
