// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <map>
#include <memory>
#include <string>

#include "swiftlet/base/time.hpp"

namespace swiftlet::test {

/// Writes .db3 files for tests with the tables of ROS 2's recorder: the few of its first version.
class Rosbag2Writer {
 public:
  explicit Rosbag2Writer(const std::filesystem::path& path) {
    sqlite3* raw = nullptr;
    EXPECT_EQ(sqlite3_open(path.c_str(), &raw), SQLITE_OK);
    database_.reset(raw);
    run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL, "
        "serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL)");
    run("CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL, "
        "timestamp INTEGER NOT NULL, data BLOB NOT NULL)");
    run("CREATE INDEX timestamp_idx ON messages (timestamp ASC)");
  }

  void run(const std::string& sql) {
    EXPECT_EQ(sqlite3_exec(database_.get(), sql.c_str(), nullptr, nullptr, nullptr), SQLITE_OK)
        << sql << ": " << sqlite3_errmsg(database_.get());
  }
  /// `type` as ROS 2 writes it, as in "nav_msgs/msg/Odometry".
  void message(const std::string& topic, const std::string& type, Stamp time,
               const std::string& data) {
    const auto [place, is_new] = topics_.emplace(topic, topics_.size() + 1);
    if (is_new)
      run("INSERT INTO topics VALUES(" + std::to_string(place->second) + ", '" + topic + "', '" +
          type + "', 'cdr', '')");
    sqlite3_stmt* row = nullptr;
    const char* sql = "INSERT INTO messages(topic_id, timestamp, data) VALUES(?, ?, ?)";
    EXPECT_EQ(sqlite3_prepare_v2(database_.get(), sql, -1, &row, nullptr), SQLITE_OK);
    sqlite3_bind_int64(row, 1, static_cast<sqlite3_int64>(place->second));
    sqlite3_bind_int64(row, 2, time.ns);
    sqlite3_bind_blob(row, 3, data.data(), static_cast<int>(data.size()), SQLITE_TRANSIENT);
    EXPECT_EQ(sqlite3_step(row), SQLITE_DONE);
    sqlite3_finalize(row);
  }

 private:
  struct Close {
    void operator()(sqlite3* database) const { sqlite3_close(database); }
  };
  std::unique_ptr<sqlite3, Close> database_;
  std::map<std::string, std::size_t> topics_;
};

}  // namespace swiftlet::test
