// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// The built program, end to end: what it says, how it exits, what it leaves behind.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/support/blocks_of.hpp"
#include "app/support/run_program.hpp"
#include "support/recordings.hpp"
#include "swiftlet/app/command.hpp"
#include "swiftlet/store/saved_map.hpp"

namespace swiftlet::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

class Program : public ::testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_ / "rec");
    write_seven_scenes(folder_ / "rec");
  }

  Ended swiftlet(const std::vector<std::string>& arguments) const {
    return run(arguments, folder_.path());
  }
  /// Maps the folder of three good frames.
  Ended map_to(const std::string& file, std::vector<std::string> more = {}) const {
    std::vector<std::string> arguments{"map", "7scenes:rec", "-o", file};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return swiftlet(arguments);
  }
  /// Every file of the working folder whose name begins so: a map and whatever stands beside it.
  std::vector<std::string> left_behind(const std::string& begin) const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
      const std::string name = entry.path().filename();
      if (name.starts_with(begin)) names.push_back(name);
    }
    return names;
  }

  TempFolder folder_;
};

/// The program answers with this exit code, one clear line, and nothing on standard output.
void expect_refusal(const Ended& ended, int exit_code, const std::string& what) {
  EXPECT_EQ(ended.exit_code, exit_code) << ended.err;
  EXPECT_THAT(ended.err, HasSubstr("swiftlet: "));
  EXPECT_THAT(ended.err, HasSubstr(what));
  EXPECT_THAT(ended.out, IsEmpty());
}

// ---- what it says of itself

TEST_F(Program, help_of_every_command_is_the_golden_text) {
  const auto expect_golden = [&](const std::string& name, const std::vector<std::string>& words) {
    const Ended ended = swiftlet(words);
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.err, IsEmpty());
    const std::string path = SWIFTLET_SOURCE_DIR "/tests/golden/help_" + name + ".txt";
    if (std::getenv("SWIFTLET_WRITE_GOLDEN") != nullptr) write_file(path, ended.out);
    EXPECT_EQ(ended.out, content_of(path)) << "SWIFTLET_WRITE_GOLDEN=1 writes the files anew";
  };
  expect_golden("swiftlet", {"--help"});
  for (const auto& command : app::commands()) {
    expect_golden(std::string(command.name), {std::string(command.name), "--help"});
  }
}

TEST_F(Program, every_help_ends_with_examples) {
  for (const auto& command : app::commands()) {
    EXPECT_THAT(swiftlet({std::string(command.name), "--help"}).out,
                HasSubstr("Examples:\n  swiftlet " + std::string(command.name)));
  }
}

TEST_F(Program, tells_its_version) {
  const Ended ended = swiftlet({"--version"});
  EXPECT_EQ(ended.exit_code, 0);
  EXPECT_THAT(ended.out, StartsWith("swiftlet "));
}

TEST_F(Program, wrong_usage_is_exit_code_2) {
  expect_refusal(swiftlet({}), 2, "a command is required");
  expect_refusal(swiftlet({"mpa"}), 2, "did you mean 'map'");
  expect_refusal(swiftlet({"map"}), 2, "SOURCE is required; try 'swiftlet map --help'");
  expect_refusal(map_to("a.swl", {"--frobnicate"}), 2, "--frobnicate");
  expect_refusal(map_to("a.swl", {"--frames", "0"}), 2, "--frames");
  expect_refusal(map_to("a.swl", {"--store", "perhaps"}), 2, "--store");
  expect_refusal(map_to("a.swl", {"--max-bytes", "5 parsecs"}), 2, "--max-bytes");
  expect_refusal(map_to("a.swl", {"--rays", "magic"}), 2, "voxel_traversal, line_drawing");
  expect_refusal(swiftlet({"map", "rec"}), 2, "7scenes:rec");
  expect_refusal(swiftlet({"map", "magic:rec"}), 2, "unknown source 'magic'");
  expect_refusal(swiftlet({"list", "magic"}), 2, "KIND");
  expect_refusal(swiftlet({"list", "rays", "--markdown"}), 2, "list parameters --markdown");
  expect_refusal(swiftlet({"render", "a.swl", "-o", "a.png", "--view", "magic"}), 2, "slice");
  expect_refusal(swiftlet({"export", "a.swl"}), 2, "--to is required");
  EXPECT_THAT(left_behind("a."), IsEmpty());
}

TEST_F(Program, lists_every_kind_of_thing_for_people_and_for_machines) {
  const Ended text = swiftlet({"list"});
  EXPECT_EQ(text.exit_code, 0);
  const json all = json::parse(swiftlet({"list", "--json"}).out);
  for (const char* kind :
       {"sources", "scenes", "steps", "rays", "integrators", "exporters", "views", "parameters"}) {
    EXPECT_THAT(text.out, HasSubstr(kind));
    ASSERT_FALSE(all.at(kind).empty()) << kind;
    for (const auto& line : all.at(kind)) {
      EXPECT_THAT(text.out, HasSubstr(line.at("name").get<std::string>()));
    }
  }
}

TEST_F(Program, says_so_if_standard_output_cannot_be_written) {
  for (const std::string command : {"list", "list --json", "map 7scenes:rec"}) {
    const int status =
        std::system(("cd '" + folder_.path().string() + "' && '" SWIFTLET_PROGRAM "' " + command +
                     " > /dev/full 2> err")
                        .c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << command;
    EXPECT_THAT(content_of(folder_ / "err"), HasSubstr("standard output")) << command;
  }
  EXPECT_EQ(swiftlet({"check", "map.swl"}).exit_code, 0) << "the map is saved nevertheless";
}

TEST_F(Program, a_flight_goes_on_if_its_progress_cannot_be_shown) {
  EXPECT_EQ(std::system(("cd '" + folder_.path().string() +
                         "' && '" SWIFTLET_PROGRAM "' map 7scenes:rec > out 2> /dev/full")
                            .c_str()),
            0);
}

// ---- mapping

TEST_F(Program, maps_a_folder_and_tells_what_it_did) {
  const Ended ended = map_to("a.swl");
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  for (const char* part : {"frames     3 in", "dropped    none", "p50", "p99", "integrate",
                           "occupied", "window", "a.swl ("}) {
    EXPECT_THAT(ended.out, HasSubstr(part));
  }
  EXPECT_THAT(left_behind("a.swl"), ::testing::ElementsAre("a.swl")) << "one single file";
}

TEST_F(Program, progress_is_plain_lines_in_a_pipe_and_standard_output_stays_clean) {
  const Ended ended = map_to("a.swl", {"--json"});
  EXPECT_THAT(ended.err,
              AllOf(HasSubstr("3/3 frames"), Not(HasSubstr("\r")), Not(HasSubstr("\033"))));
  const json summary = json::parse(ended.out);
  EXPECT_EQ(summary.at("frames"), 3);
  EXPECT_EQ(summary.at("dropped"), json::object());
  EXPECT_GT(summary.at("cells").at("occupied"), 0);
  EXPECT_GT(summary.at("cells").at("free"), 0);
  EXPECT_GE(summary.at("latency_ms").at("p99"), summary.at("latency_ms").at("p50"));
  EXPECT_EQ(summary.at("map").at("path"), "a.swl");
  EXPECT_EQ(summary.at("map").at("bytes"), std::filesystem::file_size(folder_ / "a.swl"));
}

TEST_F(Program, a_second_run_gives_the_same_map_bits) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  ASSERT_EQ(map_to("b.swl").exit_code, 0);
  EXPECT_FALSE(blocks_of(folder_ / "a.swl").empty());
  EXPECT_EQ(blocks_of(folder_ / "a.swl"), blocks_of(folder_ / "b.swl"));
}

TEST_F(Program, stops_after_the_frames_that_were_asked_for) {
  EXPECT_EQ(json::parse(map_to("a.swl", {"--json", "--frames", "2"}).out).at("frames"), 2);
}

TEST_F(Program, frames_without_a_reading_are_counted_and_told) {
  write_seven_scenes_frame(folder_ / "rec", 3, flat(0));
  const json summary = json::parse(map_to("a.swl", {"--json"}).out);
  EXPECT_EQ(summary.at("frames"), 3);
  EXPECT_EQ(summary.at("dropped"), (json{{"no_readings", 1}}));
}

TEST_F(Program, tells_where_the_intrinsics_came_from_in_summary_map_and_doctor) {
  const std::string file = "rec/camera-intrinsics.txt";
  EXPECT_THAT(map_to("a.swl").out, HasSubstr("intrinsics file: " + file));
  EXPECT_THAT(swiftlet({"info", "a.swl"}).out, HasSubstr("intrinsics file: " + file));
  EXPECT_THAT(swiftlet({"doctor", "7scenes:rec"}).out, HasSubstr("file: " + file));
  const json summary =
      json::parse(swiftlet({"map", "7scenes:rec?intrinsics=20,20,11.5,7.5", "--json"}).out);
  EXPECT_EQ(summary.at("intrinsics"), (json{{"from", "option"}, {"detail", "20,20,11.5,7.5"}}));
}

TEST_F(Program, doubts_a_depth_unit_that_nobody_told_and_through_which_all_is_near) {
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

TEST_F(Program, does_not_overwrite_a_map_unless_told_to) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  const std::string before = content_of(folder_ / "a.swl");
  expect_refusal(map_to("a.swl", {"--frames", "1"}), 2, "a.swl: the file exists; add --overwrite");
  EXPECT_EQ(content_of(folder_ / "a.swl"), before);
  ASSERT_EQ(map_to("a.swl", {"--frames", "1", "--overwrite"}).exit_code, 0);
  EXPECT_EQ(load_map(folder_ / "a.swl")->frames(), 1U);
}

TEST_F(Program, overwrite_keeps_the_old_map_if_there_is_nothing_to_map) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  const std::string before = content_of(folder_ / "a.swl");
  for (const int number : {0, 1, 2}) write_seven_scenes_frame(folder_ / "rec", number, flat(0));
  EXPECT_EQ(map_to("a.swl", {"--overwrite"}).exit_code, 1);
  EXPECT_EQ(content_of(folder_ / "a.swl"), before);
}

TEST_F(Program, the_map_carries_the_config_it_was_made_with) {
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

TEST_F(Program, the_ray_method_is_chosen_by_its_option) {
  ASSERT_EQ(map_to("a.swl", {"--rays", "line_drawing", "--set", "depth.downsample=1"}).exit_code,
            0);
  EXPECT_THAT(load_map(folder_ / "a.swl")->meta().at("config"), HasSubstr("line_drawing"));
}

// ---- what can be done with a map

TEST_F(Program, draws_every_view_and_exports_every_format_that_is_built) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  const json all = json::parse(swiftlet({"list", "--json"}).out);
  for (const auto& view : all.at("views")) {
    const std::string name = view.at("name");
    const Ended ended = swiftlet({"render", "a.swl", "-o", name + ".png", "--view", name});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(content_of(folder_ / (name + ".png")), StartsWith("\x89PNG"));
  }
  for (const auto& format : all.at("exporters")) {
    const std::string name = format.at("name");
    const Ended ended = swiftlet({"export", "a.swl", "--to", name, "-o", "a." + name});
    EXPECT_EQ(ended.exit_code, format.at("is_built") ? 0 : 1) << ended.err;
    EXPECT_EQ(std::filesystem::exists(folder_ / ("a." + name)), format.at("is_built").get<bool>());
  }
}

TEST_F(Program, pictures_and_exports_that_cannot_be_written_are_told_and_leave_nothing) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  expect_refusal(swiftlet({"render", "a.swl", "-o", "no/such/a.png"}), 1, "no/such/a.png");
  expect_refusal(swiftlet({"export", "a.swl", "--to", "ply", "-o", "no/such/a.ply"}), 1, "a.ply");
  expect_refusal(run({"render", "a.swl", "-o", "x.png"}, folder_.path(), 64), 1, "x.png");
  expect_refusal(run({"export", "a.swl", "--to", "ply", "-o", "x.ply"}, folder_.path(), 64), 1,
                 "x.ply");
  EXPECT_THAT(left_behind("x."), IsEmpty());
}

// ---- checking

TEST_F(Program, checks_maps_and_configs_and_lists_every_fault) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  write_file(folder_ / "good.yaml", "map: {voxel_m: 0.1}\n");
  write_file(folder_ / "bad.yaml", "map:\n  voxel_cm: 10\ndepth:\n  downsample: many\n");
  const Ended good = swiftlet({"check", "a.swl", "good.yaml"});
  EXPECT_EQ(good.exit_code, 0) << good.err;
  const Ended bad = swiftlet({"check", "a.swl", "bad.yaml", "none.swl"});
  EXPECT_EQ(bad.exit_code, 1);
  EXPECT_THAT(bad.out, HasSubstr("a.swl: good"));
  EXPECT_THAT(bad.err,
              AllOf(HasSubstr("bad.yaml:2: "), HasSubstr("bad.yaml:4: "), HasSubstr("none.swl")));
}

}  // namespace
}  // namespace swiftlet::test
