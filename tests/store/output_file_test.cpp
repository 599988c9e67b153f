// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/file/output_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <csignal>
#include <set>

#include "support/temp_folder.hpp"
#include "swiftlet/file/file_names.hpp"
#include "swiftlet/store/map_file/map_file.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::write_file;

std::size_t files_in(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(OutputFile, appears_whole_under_its_name_and_only_at_the_end) {
  const test::TempFolder folder;
  write_file(folder / "a.txt", "old");
  std::string text;
  for (int i = 0; i < 40'000; ++i) text += std::to_string(i);  // more than any buffer
  {
    auto file = OutputFile::create(folder / "a.txt");
    ASSERT_TRUE(file) << file.error().text();
    file->write(text);
    EXPECT_EQ(content_of(folder / "a.txt"), "old");
    EXPECT_TRUE(file->commit());
    EXPECT_EQ(content_of(folder / "a.txt"), text);
    auto given_up = OutputFile::create(folder / "a.txt");
    given_up->write("half of it");
  }
  EXPECT_EQ(content_of(folder / "a.txt"), text);
  EXPECT_EQ(files_in(folder.path()), 1U) << "no temporary file is left";
}

TEST(OutputFile, has_a_temporary_name_that_nobody_can_guess_or_lay_a_link_under) {
  const test::TempFolder folder;
  write_file(folder / "mine.txt", "mine");
  write_file(folder / "a.ply.part", "also mine");
  fs::create_symlink("mine.txt", folder / "a.ply");
  std::set<std::string> names;
  for (int i = 0; i < 20; ++i) {
    auto file = OutputFile::create(folder / "a.ply");
    ASSERT_TRUE(file);
    for (const auto& entry : fs::directory_iterator(folder.path())) names.insert(entry.path());
    file->write("theirs");
    ASSERT_TRUE(file->commit());
  }
  EXPECT_EQ(names.size(), 3U + 20U) << "each time another";
  EXPECT_EQ(content_of(folder / "mine.txt"), "mine") << "the link was replaced, not followed";
  EXPECT_EQ(content_of(folder / "a.ply.part"), "also mine");
  EXPECT_EQ(content_of(folder / "a.ply"), "theirs");
}

TEST(OutputFile, is_never_an_input_a_map_a_device_or_a_folder) {
  const test::TempFolder folder;
  write_file(folder / "in.bag", "precious");
  fs::create_hard_link(folder / "in.bag", folder / "twin");
  fs::create_symlink("in.bag", folder / "link");
  ASSERT_TRUE(MapFile::create(folder / "map.swl", false, {{"voxel_m", "0.1"}, {"frames", "0"}}));
  fs::rename(folder / "map.swl", folder / "map.png");  // its name does not matter
  const std::array inputs{fs::path("/no/such/file"), folder / "in.bag"};
  for (const char* name : {"in.bag", "twin", "link", "map.png", "."}) {
    const auto file = OutputFile::create(folder / name, inputs);
    ASSERT_FALSE(file) << name;
    EXPECT_EQ(file.error().code, ErrorCode::kUsage);
  }
  EXPECT_FALSE(OutputFile::create("/dev/null"));
  EXPECT_TRUE(OutputFile::create(folder / "in.bag")) << "an old output, for all that is known";
  EXPECT_EQ(content_of(folder / "in.bag"), "precious");
  EXPECT_EQ(files_in(folder.path()), 4U);
}

TEST(OutputFile, tells_why_it_cannot_be_written_whole) {
  const test::TempFolder folder;
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &small);
  auto file = OutputFile::create(folder / "a.txt");
  file->write(std::string(100'000, 'x'));
  const auto done = file->commit();
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, old);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().text(), ::testing::HasSubstr("File too large"));
  EXPECT_FALSE(fs::exists(folder / "a.txt"));
}

TEST(FileNames, a_file_is_never_renamed_over_another) {
  const test::TempFolder folder;
  write_file(folder / "a", "a");
  write_file(folder / "b", "b");
  fs::create_symlink("nowhere", folder / "c");
  EXPECT_FALSE(rename_to_new(folder / "a", folder / "b"));
  EXPECT_FALSE(rename_to_new(folder / "a", folder / "c")) << "a link to nothing is something, too";
  EXPECT_TRUE(rename_to_new(folder / "a", folder / "d"));
  EXPECT_EQ(content_of(folder / "b"), "b");
  EXPECT_EQ(content_of(folder / "d"), "a");
}

}  // namespace
}  // namespace swiftlet
