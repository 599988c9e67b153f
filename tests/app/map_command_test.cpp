// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// `swiftlet map` as it is built, end to end: what it tells, and what it puts into the map.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/support/blocks_of.hpp"
#include "app/support/program_fixture.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class MapCommand : public ProgramFixture {};

TEST_F(MapCommand, maps_a_folder_and_tells_what_it_did) {
  const Ended ended = map_to("a.swl");
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* part : {"frames     3 in", "dropped    none", "p50", "p99", "integrate",
                           "occupied", "window", "a.swl ("}) {
    EXPECT_THAT(ended.out, HasSubstr(part));
  }
  EXPECT_THAT(left_behind("a.swl"), ::testing::ElementsAre("a.swl")) << "one single file";
}

TEST_F(MapCommand, progress_is_plain_lines_in_a_pipe_and_standard_output_stays_clean) {
  const Ended ended = map_to("a.swl", {"--json"});
  EXPECT_THAT(ended.err,
              AllOf(HasSubstr("3/3 frames"), Not(HasSubstr("\r")), Not(HasSubstr("\033"))));
  const json summary = json::parse(ended.out);
  EXPECT_EQ(summary.at("frames"), 3);
  EXPECT_EQ(summary.at("dropped"), json::object());
  EXPECT_GT(summary.at("voxels").at("occupied"), 0);
  EXPECT_GT(summary.at("voxels").at("free"), 0);
  EXPECT_GE(summary.at("latency_ms").at("p99"), summary.at("latency_ms").at("p50"));
  EXPECT_EQ(summary.at("map").at("path"), "a.swl");
  EXPECT_EQ(summary.at("map").at("bytes"), std::filesystem::file_size(folder_ / "a.swl"));
}

TEST_F(MapCommand, a_second_run_gives_the_same_map_bits) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  ASSERT_EQ(map_to("b.swl").exit_code, 0);
  EXPECT_FALSE(blocks_of(folder_ / "a.swl").empty());
  EXPECT_EQ(blocks_of(folder_ / "a.swl"), blocks_of(folder_ / "b.swl"));
}

TEST_F(MapCommand, stops_after_the_frames_that_were_asked_for) {
  EXPECT_EQ(json::parse(map_to("a.swl", {"--json", "--frames", "2"}).out).at("frames"), 2);
}

TEST_F(MapCommand, frames_without_a_reading_are_counted_and_told) {
  write_seven_scenes_frame(folder_ / "rec", 3, flat(0));
  const json summary = json::parse(map_to("a.swl", {"--json"}).out);
  EXPECT_EQ(summary.at("frames"), 3);
  EXPECT_EQ(summary.at("dropped"), (json{{"no_readings", 1}}));
}

TEST_F(MapCommand, tells_where_the_intrinsics_came_from_in_summary_map_and_doctor) {
  const std::string file = "rec/camera-intrinsics.txt";
  EXPECT_THAT(map_to("a.swl").out, HasSubstr("intrinsics file: " + file));
  EXPECT_THAT(swiftlet({"info", "a.swl"}).out, HasSubstr("intrinsics file: " + file));
  EXPECT_THAT(swiftlet({"doctor", "7scenes:rec"}).out, HasSubstr("file: " + file));
  const json summary =
      json::parse(swiftlet({"map", "7scenes:rec?intrinsics=20,20,11.5,7.5", "--json"}).out);
  EXPECT_EQ(summary.at("intrinsics"), (json{{"from", "option"}, {"detail", "20,20,11.5,7.5"}}));
}

TEST_F(MapCommand, doubts_a_depth_unit_that_nobody_told_and_through_which_all_is_near) {
  const auto doubt_of = [&](const std::string& source) {
    return json::parse(swiftlet({"map", source, "--json", "--overwrite"}).out)
        .at("depth_doubt")
        .get<std::string>();
  };
  EXPECT_EQ(doubt_of("7scenes:rec"), "") << "a wall at 2 m";
  for (const int number : {0, 1, 2}) write_seven_scenes_frame(folder_ / "rec", number, flat(450));
  EXPECT_THAT(doubt_of("7scenes:rec"), HasSubstr("nearer than 0.45 m"));
  EXPECT_THAT(swiftlet({"doctor", "7scenes:rec"}).out, HasSubstr("nearer than 0.45 m"));
  EXPECT_EQ(doubt_of("7scenes:rec?depth_unit_m=0.001"), "") << "it was told";
  for (const int number : {0, 1, 2}) write_seven_scenes_frame(folder_ / "rec", number, flat(30000));
  write_seven_scenes_frame(folder_ / "rec", 3, flat(2000));
  EXPECT_THAT(doubt_of("7scenes:rec"), HasSubstr("farther than 10 m"));
}

TEST_F(MapCommand, does_not_overwrite_a_map_unless_told_to) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  const std::string before = content_of(folder_ / "a.swl");
  expect_refusal(map_to("a.swl", {"--frames", "1"}), 2, "a.swl: the file exists; add --overwrite");
  EXPECT_EQ(content_of(folder_ / "a.swl"), before);
  ASSERT_EQ(map_to("a.swl", {"--frames", "1", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(load_map(folder_ / "a.swl")->frames(), 1U);
}

TEST_F(MapCommand, overwrite_keeps_the_old_map_if_there_is_nothing_to_map) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  const std::string before = content_of(folder_ / "a.swl");
  for (const int number : {0, 1, 2}) write_seven_scenes_frame(folder_ / "rec", number, flat(0));
  EXPECT_EQ(map_to("a.swl", {"--overwrite"}).exit_code, 1);
  EXPECT_EQ(content_of(folder_ / "a.swl"), before);
}

TEST_F(MapCommand, the_map_carries_the_config_it_was_made_with) {
  write_file(folder_ / "f.yaml", "map: {voxel_m: 0.1}\ndepth: {downsample: 4}\n");
  ASSERT_EQ(map_to("a.swl", {"--config", "f.yaml", "--set", "sensor.p_max=0.9"}).exit_code, 0);
  const json info = json::parse(swiftlet({"info", "a.swl", "--json"}).out);
  EXPECT_EQ(info.at("voxel_m"), 0.1);
  EXPECT_EQ(info.at("frames"), 3);
  EXPECT_EQ(info.at("meta").at("source"), "7scenes:rec");
  EXPECT_EQ(info.at("meta").at("start_m"), "0 0 0") << "the first pose is the identity";
  // Maps the same again from nothing but what the file tells.
  write_file(folder_ / "echo.yaml", info.at("meta").at("config").get<std::string>());
  ASSERT_EQ(map_to("b.swl", {"--config", "echo.yaml"}).exit_code, 0);
  EXPECT_EQ(blocks_of(folder_ / "a.swl"), blocks_of(folder_ / "b.swl"));
}

TEST_F(MapCommand, the_ray_method_is_chosen_by_its_option) {
  ASSERT_EQ(map_to("a.swl", {"--rays", "line_drawing", "--set", "depth.downsample=1"}).exit_code,
            0);
  EXPECT_THAT(load_map(folder_ / "a.swl")->meta().at("config"), HasSubstr("line_drawing"));
}

TEST_F(MapCommand, the_map_keeps_what_was_to_be_told_of_the_flight) {
  for (const int number : {0, 1, 2}) write_seven_scenes_frame(folder_ / "rec", number, flat(450));
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  EXPECT_THAT(swiftlet({"info", "a.swl"}).out, HasSubstr("depth_doubt all that it sees is nearer"));
  const json told = json::parse(swiftlet({"info", "a.swl", "--json"}).out);
  EXPECT_THAT(told.at("meta").at("depth_doubt").get<std::string>(), HasSubstr("nearer than 0.45"));
  EXPECT_EQ(swiftlet({"check", "a.swl"}).exit_code, 0);
}

}  // namespace
}  // namespace swiftlet::test
