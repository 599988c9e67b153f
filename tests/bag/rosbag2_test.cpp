// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Recordings of ROS 2 in databases, in folders and packed. Files of others: recorded/ and
// tests/peers.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zstd.h>

#include "support/bag_writer.hpp"
#include "support/rosbag2_writer.hpp"
#include "support/seeds.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/bag/open_recording.hpp"
#include "swiftlet/bag/rosbag2/recording_folder.hpp"

namespace swiftlet {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kData("\0\1\0\0data", 8);  // CDR begins so

struct RecordingReading {
  std::vector<std::string> messages{};  // "topic type time bytes"
  std::string error{};
  RecordingInfo info{};
};

RecordingReading read_recording(const std::filesystem::path& path) {
  RecordingReading reading;
  auto reader = open_recording(path);
  if (!reader) {
    reading.error = reader.error().text();
    return reading;
  }
  while (true) {
    const auto message = (*reader)->next();
    if (!message) reading.error = message.error().text();
    if (!message || !*message) break;
    reading.messages.push_back(fmt::format("{} {} {} {}", (*message)->connection->topic,
                                           (*message)->connection->type, (*message)->record_time.ns,
                                           (*message)->data.size()));
    EXPECT_THAT((*reader)->place_of(**message), HasSubstr((*message)->connection->topic));
  }
  reading.info = (*reader)->info();
  return reading;
}

std::string packed(const std::string& text) {
  std::string out(ZSTD_compressBound(text.size()), '\0');
  out.resize(ZSTD_compress(out.data(), out.size(), text.data(), text.size(), 1));
  return out;
}

void write_database(const std::filesystem::path& path, int first, int count) {
  test::Rosbag2Writer writer(path);
  for (int i = first; i < first + count; ++i)
    writer.message(i % 2 == 0 ? "/a" : "/b", "std_msgs/msg/String", Stamp{i}, kData);
}

TEST(Rosbag2, is_read_in_the_order_of_its_rows_whatever_its_name_and_is_not_changed) {
  const test::TempFolder folder;
  write_database(folder / "bag.txt", 1, 3);
  const std::string before = test::content_of(folder / "bag.txt");
  const RecordingReading reading = read_recording(folder / "bag.txt");
  EXPECT_EQ(reading.error, "");
  EXPECT_THAT(reading.messages, ElementsAre("/b std_msgs/String 1 8", "/a std_msgs/String 2 8",
                                            "/b std_msgs/String 3 8"));
  EXPECT_EQ(reading.info.format, "rosbag2 SQLite");
  EXPECT_EQ(test::content_of(folder / "bag.txt"), before);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Rosbag2, whose_messages_were_packed_one_by_one_is_unpacked) {
  const test::TempFolder folder;
  {
    test::Rosbag2Writer writer(folder / "bag.db3");
    writer.message("/a", "std_msgs/msg/String", Stamp{1}, packed(kData));
    writer.message("/a", "std_msgs/msg/String", Stamp{2}, packed(kData).substr(0, 10));
  }
  const RecordingReading reading = read_recording(folder / "bag.db3");
  EXPECT_THAT(reading.messages, ElementsAre("/a std_msgs/String 1 8"));
  EXPECT_THAT(reading.error, HasSubstr("message 2 (/a): the message cannot be unpacked"));
}

TEST(Rosbag2, packed_as_a_whole_is_unpacked_and_leaves_nothing_behind) {
  const test::TempFolder folder, temporary;
  write_database(folder / "bag_0.db3", 0, 4);
  const std::string whole = test::content_of(folder / "bag_0.db3");
  test::write_file(folder / "bag_0.db3.zstd", packed(whole));
  std::filesystem::remove(folder / "bag_0.db3");
  setenv("TMPDIR", temporary.path().c_str(), 1);
  EXPECT_EQ(read_recording(folder / "bag_0.db3.zstd").messages.size(), 4U);
  EXPECT_EQ(read_recording(folder.path()).messages.size(), 4U);
  test::write_file(folder / "cut.zstd", packed(whole).substr(0, 100));
  EXPECT_THAT(read_recording(folder / "cut.zstd").error, HasSubstr("end too early"));
  EXPECT_TRUE(std::filesystem::is_empty(temporary.path()));
  unsetenv("TMPDIR");
}

TEST(Rosbag2, whose_recorder_was_killed_is_read_with_its_log) {
  const test::TempFolder folder;
  test::Rosbag2Writer writer(folder / "live.db3");
  writer.run("PRAGMA journal_mode=WAL");
  for (int i = 0; i < 3; ++i) writer.message("/a", "std_msgs/msg/String", Stamp{i}, kData);
  // As a killed writer leaves it: the database is empty, the log is not.
  for (const char* tail : {"", "-wal"})
    std::filesystem::copy_file(folder / (std::string("live.db3") + tail),
                               folder / (std::string("killed.db3") + tail));
  EXPECT_EQ(read_recording(folder / "killed.db3").messages.size(), 3U);
}

TEST(Rosbag2, that_is_another_database_is_told_from_a_recording) {
  const test::TempFolder folder;
  {
    test::Rosbag2Writer writer(folder / "other.db3");
    writer.run("DROP TABLE topics");
  }
  EXPECT_FALSE(is_recording(folder / "other.db3"));
  EXPECT_THAT(read_recording(folder / "other.db3").error, HasSubstr("no recording of ROS 2"));
  {
    test::Rosbag2Writer writer(folder / "view.db3");
    writer.run("DROP TABLE messages");
    writer.run("CREATE VIEW messages AS SELECT 1 AS id, 1 AS topic_id, 1 AS timestamp, 1 AS data");
  }
  EXPECT_NE(read_recording(folder / "view.db3").error, "") << "nothing in a file may run";
}

TEST(Rosbag2, cut_or_damaged_anywhere_does_no_harm) {
  const test::TempFolder folder;
  write_database(folder / "sound.db3", 0, 200);
  const std::string sound = test::content_of(folder / "sound.db3");
  for (std::size_t bytes = 0; bytes < sound.size(); bytes += 511) {
    test::write_file(folder / "cut.db3", sound.substr(0, bytes));
    EXPECT_LE(read_recording(folder / "cut.db3").messages.size(), 200U);
  }
  test::for_each_seed(100, [&](test::Random& random) {
    std::string noisy = sound;
    for (int i = 0; i < 20; ++i)
      noisy[random.integer<std::size_t>(16, noisy.size() - 1)] =
          static_cast<char>(random.integer(0, 255));
    test::write_file(folder / "noisy.db3", noisy);
    (void)read_recording(folder / "noisy.db3");
  });
}

TEST(RecordingFolder, is_read_file_after_file_by_number_with_and_without_metadata) {
  const test::TempFolder folder;
  for (const int i : {0, 1, 2, 10})
    write_database(folder / ("flight_" + std::to_string(i) + ".db3"), 2 * i, 2);
  test::write_file(folder / "notes.txt", "what the pilot saw");
  const std::vector<std::string> all{"/a std_msgs/String 0 8",  "/b std_msgs/String 1 8",
                                     "/a std_msgs/String 2 8",  "/b std_msgs/String 3 8",
                                     "/a std_msgs/String 4 8",  "/b std_msgs/String 5 8",
                                     "/a std_msgs/String 20 8", "/b std_msgs/String 21 8"};
  const RecordingReading reading = read_recording(folder.path());
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.messages, all);
  EXPECT_EQ(reading.info.files, 4U);
  test::write_file(folder / "metadata.yaml",
                   "rosbag2_bagfile_information:\n  relative_file_paths:\n    - flight_0.db3\n"
                   "    - old_name/flight_10.db3\n");
  EXPECT_EQ(read_recording(folder.path()).messages.size(), 4U);
}

TEST(RecordingFolder, takes_a_file_that_lies_beside_its_packed_form_once) {
  const test::TempFolder folder;
  write_database(folder / "flight.v2_0.db3", 0, 2);
  write_database(folder / "flight.v2_1.db3", 2, 2);
  test::write_file(folder / "flight.v2_0.db3.zstd",
                   packed(test::content_of(folder / "flight.v2_0.db3")));
  const RecordingReading reading = read_recording(folder.path());
  EXPECT_EQ(reading.error, "");
  EXPECT_EQ(reading.messages.size(), 4U);
  test::write_file(folder / "metadata.yaml",
                   "rosbag2_bagfile_information:\n  relative_file_paths:\n"
                   "    - flight.v2_1.db3.zstd\n");
  EXPECT_EQ(read_recording(folder.path()).messages.size(), 2U) << "the user has unpacked it";
}

TEST(RecordingFolder, does_not_join_what_is_not_one_recording) {
  const test::TempFolder folder;
  write_database(folder / "2026.11.28_kitchen.db3", 0, 2);
  write_database(folder / "2026.11.29_garden.db3", 2, 2);
  EXPECT_THAT(read_recording(folder.path()).error, HasSubstr("several recordings"));
  const test::TempFolder other;
  write_database(other / "f_0.db3", 0, 2);
  test::BagWriter bag;
  bag.message("/a", "std_msgs/String", Stamp{1}, "data");
  bag.end_chunk();
  test::write_file(other / "f_0.bag", bag.bag());
  EXPECT_THAT(read_recording(other.path()).error, HasSubstr("have the same number"));
}

TEST(RecordingFolder, may_hold_bags_of_ros_1) {
  const test::TempFolder folder;
  for (const int i : {0, 1}) {
    test::BagWriter bag;
    bag.message("/a", "std_msgs/String", Stamp{i}, "data");
    bag.end_chunk();
    test::write_file(folder / ("flight_" + std::to_string(i) + ".bag"), bag.bag());
  }
  EXPECT_THAT(read_recording(folder.path()).messages,
              ElementsAre("/a std_msgs/String 0 4", "/a std_msgs/String 1 4"));
}

TEST(RecordingFolder, without_or_with_several_recordings_is_told_what_to_do) {
  const test::TempFolder folder;
  EXPECT_THAT(read_recording(folder.path()).error, HasSubstr("holds no recording"));
  write_database(folder / "one.db3", 0, 1);
  write_database(folder / "two.db3", 0, 1);
  EXPECT_THAT(read_recording(folder.path()).error, HasSubstr("name one: one.db3, two.db3"));
  test::write_file(folder / "metadata.yaml",
                   "rosbag2_bagfile_information:\n  relative_file_paths: [gone.db3]\n");
  EXPECT_THAT(read_recording(folder.path()).error, HasSubstr("gone.db3"));
  test::write_file(folder / "metadata.yaml", "- 1\n- 2\n");
  EXPECT_THAT(read_recording(folder.path()).error, HasSubstr("metadata.yaml"));
}

TEST(RecordingFolder, whose_metadata_leave_the_folder_is_not_followed) {
  const test::TempFolder folder;
  write_database(folder / "secret.db3", 0, 1);
  std::filesystem::create_directory(folder / "bag");
  test::write_file(folder / "bag/metadata.yaml",
                   "rosbag2_bagfile_information:\n  relative_file_paths: [../secret.db3]\n");
  EXPECT_THAT(read_recording(folder / "bag").error, HasSubstr("it is not there"));
}

}  // namespace
}  // namespace swiftlet
