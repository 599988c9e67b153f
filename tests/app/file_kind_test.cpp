// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/file_kind.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "support/temp_folder.hpp"
#include "swiftlet/app/report/checked_files.hpp"
#include "swiftlet/store/map_file/save_map.hpp"
#include "swiftlet/store/map_loader.hpp"
#include "swiftlet/store/opened_map.hpp"

namespace swiftlet::app {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

const std::string kOctomap =
    "# Octomap OcTree binary file\nid OcTree\nsize 2\nres 0.1\ndata\n" + std::string("\x01\0", 2);

std::vector<std::string> faults_in(const std::filesystem::path& path) {
  std::vector<std::string> texts;
  for (const Error& fault : faults_in_file(path.string())) texts.push_back(fault.text());
  return texts;
}

TEST(FileKind, is_told_by_what_is_in_the_file_whatever_its_name) {
  const test::TempFolder folder;
  const auto look = [&](const std::string& content) {
    test::write_file(folder / "x.swl", content);
    auto facts = look_at_file(folder / "x.swl");
    EXPECT_TRUE(facts);
    return facts.value_or(FileFacts{});
  };
  EXPECT_EQ(look(kOctomap).kind, FileKind::kOctomap);
  EXPECT_EQ(look("#ROSBAG V2.0\n").kind, FileKind::kBag);
  EXPECT_EQ(look("map:\n  voxel_m: 0.1\n").kind, FileKind::kText);
  EXPECT_THAT(look("\x89PNG\r\n\x1a\n").what, HasSubstr("PNG"));
  EXPECT_THAT(look("\x1f\x8b\x08").what, HasSubstr("gzip"));
  EXPECT_THAT(look(std::string("SQLite format 3\0", 16) + std::string(100, '\0')).what,
              HasSubstr("another program"));
  EXPECT_THAT(look("").what, HasSubstr("empty"));
  EXPECT_THAT(look(std::string("\0\1\2\3", 4)).what, HasSubstr("no kind"));

  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THAT(look_at_file(folder / "pipe").error().what, HasSubstr("pipe"));
  EXPECT_THAT(look_at_file(folder / ".").error().what, HasSubstr("folder"));
  EXPECT_THAT(look_at_file("/dev/zero").error().what, HasSubstr("device"));
  EXPECT_EQ(look_at_file(folder / "none").error().code, ErrorCode::kNotFound);
}

TEST(FileKind, maps_of_both_kinds_are_opened_under_any_name_and_others_are_named) {
  const test::TempFolder folder;
  BlockMap map({0.1, {}, 1});
  map.set({}, kOccupiedVoxel);
  ASSERT_TRUE(save_map(folder / "map.bt", map));
  EXPECT_EQ(read_whole_map((folder / "map.bt").string())->block_count(), 1U);
  std::string small = kOctomap;  // one leaf of a whole eighth of the world is too much to lay out
  test::write_file(folder / "large.swl", small);
  EXPECT_THAT(open_map((folder / "large.swl").string()).error().what, HasSubstr("too many"));
  small = "# Octomap OcTree binary file\nid OcTree\nsize 14\nres 0.1\ndata\n";
  for (int i = 0; i < 12; ++i) small += std::string("\x03\0", 2);
  test::write_file(folder / "small.swl", small + std::string("\x02\0", 2));
  const auto opened = open_map((folder / "small.swl").string());
  ASSERT_TRUE(opened) << opened.error().text();
  EXPECT_EQ(opened->file.block_count(), 1U);
  EXPECT_EQ(opened->file.voxel_m(), 0.1);
  test::write_file(folder / "picture.swl", "\x89PNG\r\n\x1a\n");
  EXPECT_THAT(open_map((folder / "picture.swl").string()).error().text(),
              AllOf(HasSubstr("picture.swl"), HasSubstr("a PNG picture, not a map")));
}

TEST(CheckedFiles, rigs_scenes_and_configs_are_known_by_their_keys_and_faults_have_lines) {
  const test::TempFolder folder;
  test::write_file(folder / "rig.yaml", "cameras:\n  - { mount: intel_t265_d435 }\n");
  EXPECT_THAT(faults_in(folder / "rig.yaml"), IsEmpty());
  test::write_file(folder / "rig.yaml", "cameras:\n  - { mount: my_own }\n");
  EXPECT_THAT(faults_in(folder / "rig.yaml"), ElementsAre(HasSubstr("rig.yaml:2: ")));
#if SWIFTLET_HAS_EMBREE
  const std::string flight = "flight: { waypoints: [ { at_m: [0, 0, 1] } ] }\n";
  test::write_file(folder / "room",
                   "planes:\n  - { centre_m: [3, 0, 0], normal: [1, 0, 0] }\n" + flight);
  EXPECT_THAT(faults_in(folder / "room"), IsEmpty());
  test::write_file(folder / "room",
                   "planes:\n  - { centre_m: [3, 0], normal: [1, 0, 0] }\n" + flight);
  EXPECT_THAT(faults_in(folder / "room"), ElementsAre(HasSubstr("room:2: ")));
#endif
  test::write_file(folder / "config.txt", "map: { voxel_m: 0.1 }\n");
  EXPECT_THAT(faults_in(folder / "config.txt"), IsEmpty());
  test::write_file(folder / "config.txt", "map: { voxel_m: 0.1 }\nmapp: 3\n");
  EXPECT_THAT(faults_in(folder / "config.txt"), ElementsAre(HasSubstr("config.txt:2: ")));
  test::write_file(folder / "notes", "a b c\n");
  EXPECT_THAT(faults_in(folder / "notes"), Not(IsEmpty()));
  test::write_file(folder / "map.bt", kOctomap);
  EXPECT_THAT(faults_in(folder / "map.bt"), IsEmpty());
}

TEST(CheckedFiles, a_map_whose_config_the_readers_refuse_is_not_called_good) {
  const test::TempFolder folder;
  const MapMeta meta{{"voxel_m", "0.1"}, {"frames", "1"}, {"config", "map: &a {x: *a}\n"}};
  ASSERT_TRUE(MapFile::create(folder / "a.swl", false, meta));
  EXPECT_THAT(faults_in(folder / "a.swl"), ElementsAre(HasSubstr("within what it repeats")));
  EXPECT_FALSE(read_whole_map((folder / "a.swl").string()));
}

}  // namespace
}  // namespace swiftlet::app
