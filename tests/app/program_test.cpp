// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// The built program, end to end: what it says, how it exits, what it leaves behind.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/support/program_fixture.hpp"
#include "swiftlet/app/command.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet::test {
namespace {

using nlohmann::json;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

class Program : public ProgramFixture {};

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
  expect_refusal(swiftlet({"render", "a.swl", "-o", "a.png", "--projection", "magic"}), 2, "slice");
  expect_refusal(swiftlet({"export", "a.swl"}), 2, "--to is required");
  EXPECT_THAT(left_behind("a."), IsEmpty());
}

TEST_F(Program, lists_every_kind_of_thing_for_people_and_for_machines) {
  const Ended text = swiftlet({"list"});
  EXPECT_EQ(text.exit_code, 0);
  const json all = json::parse(swiftlet({"list", "--json"}).out);
  for (const char* kind : {"sources", "scenes", "random", "steps", "models", "rays", "integrators",
                           "exporters", "projections", "parameters"}) {
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

// ---- what can be done with a map

TEST_F(Program, draws_every_view_and_exports_every_format_that_is_built) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  const json all = json::parse(swiftlet({"list", "--json"}).out);
  for (const auto& projection : all.at("projections")) {
    const std::string name = projection.at("name");
    const Ended ended = swiftlet({"render", "a.swl", "-o", name + ".png", "--projection", name});
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

TEST_F(Program, check_tells_machines_what_it_tells_people) {
  ASSERT_EQ(map_to("a.swl").exit_code, 0);
  write_file(folder_ / "bad.yaml", "map:\n  voxel_cm: 10\ndepth:\n  downsample: many\n");
  const Ended ended = swiftlet({"check", "a.swl", "bad.yaml", "none.swl", "--json"});
  EXPECT_EQ(ended.exit_code, 1);
  const json told = json::parse(ended.out);
  EXPECT_EQ(told.at("faults"), 3);
  ASSERT_EQ(told.at("files").size(), 3U);
  EXPECT_EQ(told.at("files")[0],
            (json{{"path", "a.swl"}, {"is_good", true}, {"findings", json::array()}}));
  const json& bad = told.at("files")[1];
  EXPECT_EQ(bad.at("is_good"), false);
  EXPECT_EQ(bad.at("findings")[0].at("severity"), "fault");
  EXPECT_EQ(bad.at("findings")[0].at("where"), "bad.yaml:2");
  EXPECT_EQ(told.at("files")[2].at("findings")[0].at("what"), "there is no such file");
  const json mended =
      json::parse(swiftlet({"check", "a.swl", "--repair", "-o", "b.swl", "--json"}).out);
  EXPECT_EQ(mended.at("files")[0].at("path"), "b.swl");
  EXPECT_EQ(mended.at("salvage").at("is_whole"), true);
}

// ---- exit codes

TEST_F(Program, a_file_that_is_missing_or_damaged_is_exit_code_1_for_every_reader) {
  write_file(folder_ / "noise", std::string("\0\1\2\3", 4));
  for (const std::string file : {"none", "noise", "rec"}) {
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"check", file},
          {"info", file},
          {"render", file, "-o", "x.png"},
          {"export", file, "--to", "ply", "-o", "x.ply"},
          {"compare", file, file},
          {"map", "bag:" + file},
          {"map", "7scenes:rec", "--config", file, "-o", "x.swl"}}) {
      const Ended ended = swiftlet(words);
      const bool is_config_text = file == "noise" && words.size() > 3 && words[2] == "--config";
      EXPECT_EQ(ended.exit_code, is_config_text ? 2 : 1) << words[0] << " " << file << ended.err;
    }
  }
}

}  // namespace
}  // namespace swiftlet::test
