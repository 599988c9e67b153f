// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// The recordings that rosbag2 tests itself with, written by its recorders and by libmcap.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support/recorded.hpp"
#include "swiftlet/bag/messages/message_cursor.hpp"
#include "swiftlet/bag/open_recording.hpp"

namespace swiftlet {
namespace {

namespace fs = std::filesystem;

fs::path ros2_bags() { return test::recorded_folder("ros2/rosbag2"); }

/// Messages by topic.
std::map<std::string, std::size_t> counts_in(const fs::path& path) {
  std::map<std::string, std::size_t> counts;
  auto reader = open_recording(path);
  EXPECT_TRUE(reader) << path << ": " << reader.error().text();
  if (!reader) return counts;
  while (true) {
    const auto message = (*reader)->next();
    EXPECT_TRUE(message) << path << ": " << message.error().text();
    if (!message || !*message) break;
    ++counts[(*message)->connection->topic];
    EXPECT_FALSE((*message)->connection->type.empty()) << path;
  }
  return counts;
}

TEST(Ros2Bags, are_each_read_to_their_end_as_files) {
  SWIFTLET_NEEDS_RECORDING(ros2_bags());
  std::size_t files = 0, messages = 0;
  for (const auto& entry : fs::recursive_directory_iterator(ros2_bags())) {
    if (entry.path().extension() != ".mcap" && entry.path().extension() != ".db3") continue;
    ++files;
    EXPECT_TRUE(is_recording(entry.path())) << entry.path();
    for (const auto& [topic, count] : counts_in(entry.path())) messages += count;
  }
  EXPECT_GE(files, 25U);
  EXPECT_GE(messages, 200U);
}

TEST(Ros2Bags, hold_the_same_in_both_forms_where_rosbag2_wrote_both) {
  const fs::path resources = ros2_bags() / "rosbag2_py/test/resources";
  SWIFTLET_NEEDS_RECORDING(resources);
  for (const char* name : {"convert_a", "convert_b", "reindex_test_bags/multiple_files"}) {
    const auto mcap = counts_in(resources / "mcap" / name);
    EXPECT_EQ(mcap, counts_in(resources / "sqlite3" / name)) << name;
    EXPECT_FALSE(mcap.empty()) << name;
  }
}

TEST(Ros2Bags, decode_as_the_texts_and_numbers_that_were_published) {
  const fs::path talker = ros2_bags() / "rosbag2_py/test/resources/mcap/talker";
  SWIFTLET_NEEDS_RECORDING(talker);
  for (const fs::path& path : {talker, ros2_bags() / "rosbag2_py/test/resources/sqlite3/talker"}) {
    auto reader = open_recording(path);
    ASSERT_TRUE(reader) << reader.error().text();
    std::size_t texts = 0;
    while (true) {
      const auto message = (*reader)->next();
      ASSERT_TRUE(message);
      if (!*message) break;
      if ((*message)->connection->type != "std_msgs/String") continue;
      MessageCursor cursor((*message)->serialized());
      EXPECT_THAT(std::string(cursor.read_string()),
                  ::testing::AnyOf(::testing::StartsWith("Hello World: "),
                                   ::testing::StartsWith("Hello, world! ")));
      EXPECT_TRUE(cursor.is_whole());
      ++texts;
    }
    EXPECT_GE(texts, 5U) << path;
  }
}

TEST(Ros2Bags, without_a_message_is_no_fault) {
  const fs::path empty = ros2_bags() / "ros2bag/test/resources/empty_bag";
  SWIFTLET_NEEDS_RECORDING(empty);
  EXPECT_TRUE(counts_in(empty).empty());
}

}  // namespace
}  // namespace swiftlet
