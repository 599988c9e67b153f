// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors
//
// What the program does with a map that is damaged or whose writer was killed.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "app/support/run_program.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/store/map_file/save_map.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"
#include "swiftlet/store/map_file/sqlite.hpp"

namespace swiftlet::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kBlocks = 60;

/// Blocks of wall and of free space in turn.
void write_map(const std::filesystem::path& path) {
  BlockMap map({0.1, {}, 1});
  for (int i = 0; i < kBlocks; ++i) {
    VoxelBlock block;
    block.voxels.fill(static_cast<QuantizedLogOdds>(i % 2 == 0 ? 250 : 10));
    map.put({i % 8, i / 8, 0}, block);
  }
  ASSERT_TRUE(save_map(path, map));
}

void run_sql_in(const std::filesystem::path& path, const std::string& sql) {
  auto database = sqlite::Database::open(path, sqlite::Database::Mode::kReadWrite);
  ASSERT_TRUE(database.has_value());
  ASSERT_TRUE(database->run(sql));
}

/// How each reader is called.
std::vector<std::vector<std::string>> readers() {
  return {{"info", "a.swl"},
          {"render", "a.swl", "-o", "a.png"},
          {"export", "a.swl", "--to", "ply", "-o", "a.ply"},
          {"compare", "a.swl", "a.swl"},
          {"plan", "a.swl", "--from", "1.1,0.4,0.4", "--to", "1.3,0.4,0.4", "--radius", "0.1"}};
}

TEST(DamagedMap, every_reader_keeps_the_rest_with_salvage_and_tells_what_is_missing) {
  const TempFolder folder;
  write_map(folder / "a.swl");
  run_sql_in(folder / "a.swl", "UPDATE blocks SET touched = touched + 1 WHERE x = 3 AND y = 2");
  for (auto words : readers()) {
    const Ended refused = run(words, folder.path());
    EXPECT_EQ(refused.exit_code, 1) << words[0];
    EXPECT_THAT(refused.err, HasSubstr("block 3 2 0 is damaged"));
    EXPECT_THAT(refused.err, HasSubstr("--salvage"));
    words.emplace_back("--salvage");
    const Ended salvaged = run(words, folder.path());
    EXPECT_EQ(salvaged.exit_code, 0) << words[0] << ": " << salvaged.err;
    EXPECT_THAT(salvaged.err, HasSubstr("59 of 60 blocks are kept"));
    EXPECT_THAT(salvaged.err, HasSubstr("block 3 2 0 is damaged"));
  }
  const auto info = run_for_json({"info", "a.swl", "--json", "--salvage"}, folder.path());
  EXPECT_EQ(info["blocks"], 59);
  EXPECT_EQ(info["salvage"]["missing"], 1);
}

TEST(DamagedMap, check_repairs_into_a_new_file) {
  const TempFolder folder;
  write_map(folder / "a.swl");
  run_sql_in(folder / "a.swl", "UPDATE blocks SET touched = touched + 1 WHERE x = 3 AND y = 2");
  const auto before = content_of(folder / "a.swl");
  const Ended repaired = run({"check", "a.swl", "--repair", "-o", "b.swl"}, folder.path());
  EXPECT_EQ(repaired.exit_code, 0) << repaired.err;
  EXPECT_THAT(repaired.out, HasSubstr("59 of 60 blocks are kept"));
  EXPECT_EQ(run({"check", "b.swl"}, folder.path()).exit_code, 0);
  EXPECT_EQ(content_of(folder / "a.swl"), before);
  EXPECT_EQ(run({"check", "a.swl", "--repair", "-o", "b.swl"}, folder.path()).exit_code, 2);
  EXPECT_EQ(run({"check", "a.swl", "--repair", "-o", "a.swl"}, folder.path()).exit_code, 2);
  EXPECT_EQ(run({"check", "a.swl", "--repair"}, folder.path()).exit_code, 2);
  EXPECT_EQ(run({"check", "a.swl", "-o", "c.swl"}, folder.path()).exit_code, 2);
}

TEST(CutOffMap, every_reader_opens_a_map_with_the_journal_of_a_killed_writer) {
  const TempFolder folder;
  write_map(folder / "b.swl");
  {
    auto writer = sqlite::Database::open(folder / "b.swl", sqlite::Database::Mode::kReadWrite);
    ASSERT_TRUE(
        writer->run("PRAGMA cache_size = 1; BEGIN IMMEDIATE; UPDATE blocks SET touched = 9"));
    for (const char* suffix : {"", "-journal"}) {  // as a kill at this moment leaves them
      std::filesystem::copy_file(folder / (std::string("b.swl") + suffix),
                                 folder / (std::string("a.swl") + suffix));
    }
  }
  ASSERT_GT(std::filesystem::file_size(folder / "a.swl-journal"), 0U);
  auto all = readers();
  all.push_back({"check", "a.swl"});
  for (const auto& words : all) {
    const Ended ended = run(words, folder.path());
    EXPECT_EQ(ended.exit_code, 0) << words[0] << ": " << ended.err;
    EXPECT_THAT(ended.err, IsEmpty());
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "a.swl-journal")) << "readers change nothing";
}

}  // namespace
}  // namespace swiftlet::test
