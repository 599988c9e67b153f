// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/bag/file_or_recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include "support/rosbag2_writer.hpp"
#include "support/temp_folder.hpp"

namespace swiftlet {
namespace {

using ::testing::HasSubstr;

void write_recording(const std::filesystem::path& path) {
  test::Rosbag2Writer writer(path);
  writer.message("/a", "std_msgs/msg/String", Stamp{1}, "data");
}

std::string packed_whole(const std::string& text) {
  std::string out(ZSTD_compressBound(text.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), text.data(), text.size(), 1));
  return out;
}

FileKind kind_of(const std::filesystem::path& path) {
  const auto facts = look_at_file_or_recording(path);
  EXPECT_TRUE(facts) << facts.error().text();
  return facts ? facts->kind : FileKind::kText;
}

TEST(FileOrRecording, knows_recordings_by_what_is_in_them_whatever_their_names) {
  const test::TempFolder folder;
  write_recording(folder / "map.swl");
  EXPECT_EQ(kind_of(folder / "map.swl"), FileKind::kBag);
  test::write_file(folder / "packed", packed_whole(test::content_of(folder / "map.swl")));
  EXPECT_EQ(kind_of(folder / "packed"), FileKind::kBag);
  test::write_file(folder / "other", packed_whole("a letter"));
  EXPECT_EQ(kind_of(folder / "other"), FileKind::kOther);
  test::write_file(folder / "x.txt", std::string("\x89MCAP0\r\n", 8));
  EXPECT_EQ(kind_of(folder / "x.txt"), FileKind::kBag);
  test::write_file(folder / "y.mcap", "map:\n  voxel_m: 0.1\n");
  EXPECT_EQ(kind_of(folder / "y.mcap"), FileKind::kText);
}

TEST(FileOrRecording, takes_a_database_with_a_log_for_a_map_only_if_it_is_no_recording) {
  const test::TempFolder folder;
  for (const bool is_recording : {true, false}) {
    const auto path = folder / (is_recording ? "flight.db3" : "other.db3");
    test::Rosbag2Writer writer(path);
    writer.run("PRAGMA journal_mode=WAL");
    writer.message("/a", "std_msgs/msg/String", Stamp{1}, "data");
    if (!is_recording) writer.run("DROP TABLE messages");
    EXPECT_EQ(kind_of(path), is_recording ? FileKind::kBag : FileKind::kMap);
  }
}

TEST(FileOrRecording, knows_the_folder_of_a_recording_from_any_other) {
  const test::TempFolder folder;
  std::filesystem::create_directory(folder / "flight");
  write_recording(folder / "flight/flight_0.db3");
  EXPECT_EQ(kind_of(folder / "flight"), FileKind::kBag);
  std::filesystem::create_directory(folder / "photos");
  EXPECT_THAT(look_at_file_or_recording(folder / "photos").error().text(), HasSubstr("a folder"));
  write_recording(folder / "flight/walk_0.db3");
  EXPECT_THAT(look_at_file_or_recording(folder / "flight").error().text(),
              HasSubstr("several recordings"));
}

}  // namespace
}  // namespace swiftlet
