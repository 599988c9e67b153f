// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/map_file/map_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "store/store_support.hpp"

namespace swiftlet {
namespace {

using test::TempFolder;

/// A process that writes a map of one block until it is killed.
class Writing {
 public:
  explicit Writing(const std::filesystem::path& path) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    child_ = fork();
    if (child_ == 0) write_until_killed(path, ends[1]);
    close(ends[1]);
    char is_ready = 0;
    EXPECT_EQ(read(ends[0], &is_ready, 1), 1);
    close(ends[0]);
  }
  ~Writing() { end(); }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;

  [[nodiscard]] pid_t pid() const { return child_; }
  void end() {
    if (child_ <= 0) return;
    kill(child_, SIGKILL);
    waitpid(std::exchange(child_, 0), nullptr, 0);
  }

 private:
  [[noreturn]] static void write_until_killed(const std::filesystem::path& path, int pipe) {
    auto store = BlockStore::create(path, 0.1, {.batch_interval = std::chrono::milliseconds(1)});
    if (!store) _exit(3);
    (*store)->evict({1, 2, 3}, test::block_full_of(9), 1);
    while ((*store)->stats().written == 0) usleep(1000);
    if (write(pipe, "r", 1) != 1) _exit(4);
    for (;;) pause();
  }
  pid_t child_ = 0;
};

TEST(MapLock, a_second_writer_is_refused_and_told_who_writes) {
  const TempFolder folder;
  Writing first(folder / "a.swl");
  const std::string pid = std::to_string(first.pid());
  for (const bool overwrite : {false, true}) {
    const auto second = BlockStore::create(folder / "a.swl", 0.1, {.overwrite = overwrite});
    ASSERT_FALSE(second.has_value());
    EXPECT_EQ(second.error().code, ErrorCode::kUsage);
    EXPECT_NE(second.error().text().find("process " + pid), std::string::npos)
        << second.error().text();
  }
  EXPECT_FALSE(MapFile::rename(folder / "a.swl", folder / "b.swl"));
  MapFile::remove(folder / "a.swl");
  EXPECT_FALSE(MapFile::open_to_write(folder / "a.swl", 0));
  EXPECT_EQ(test::blocks_in(folder / "a.swl"),  // and readers need not ask
            (test::Blocks{{{1, 2, 3}, test::block_full_of(9)}}));

  ASSERT_TRUE(MapFile::writer_of(folder / "a.swl").has_value());
  EXPECT_EQ(MapFile::writer_of(folder / "a.swl")->pid, first.pid());
  EXPECT_NE(MapFile::writer_of(folder / "a.swl")->command.find("store_tests"), std::string::npos);
}

TEST(MapLock, ends_with_its_process_however_that_ends) {
  const TempFolder folder;
  Writing first(folder / "a.swl");
  first.end();
  EXPECT_FALSE(MapFile::writer_of(folder / "a.swl").has_value());
  EXPECT_TRUE(BlockStore::create(folder / "a.swl", 0.1, {.overwrite = true}).has_value());
}

TEST(MapLock, follows_a_map_to_its_new_name) {
  const TempFolder folder;
  Writing first(folder / "a.swl");
  std::filesystem::rename(folder / "a.swl", folder / "b.swl");
  EXPECT_FALSE(MapFile::writer_of(folder / "a.swl").has_value());
  ASSERT_TRUE(MapFile::writer_of(folder / "b.swl").has_value());
  EXPECT_EQ(MapFile::writer_of(folder / "b.swl")->pid, first.pid());
}

TEST(MapLock, is_held_from_the_first_moment_to_close_in_this_process_too) {
  const TempFolder folder;
  auto store = BlockStore::create(folder / "a.swl", 0.1).value();
  ASSERT_TRUE(MapFile::writer_of(folder / "a.swl").has_value());
  EXPECT_EQ(MapFile::writer_of(folder / "a.swl")->pid, getpid());
  EXPECT_FALSE(BlockStore::create(folder / "a.swl", 0.1, {.overwrite = true}));
  ASSERT_TRUE(store->close());
  EXPECT_FALSE(MapFile::writer_of(folder / "a.swl").has_value());
  EXPECT_FALSE(MapFile::writer_of(folder / "none.swl").has_value());
}

TEST(MapFileNames, a_new_map_touches_no_file_of_the_user) {
  const TempFolder folder;
  test::write_file(folder / "mine", "keep me");
  for (const char* name : {"a.swl.new", "a.swl.new-journal", "a.swl.part"}) {
    std::filesystem::create_symlink(folder / "mine", folder / name);
  }
  ASSERT_TRUE(BlockStore::create(folder / "a.swl", 0.1).value()->close());
  EXPECT_EQ(test::content_of(folder / "mine"), "keep me");
  for (const char* name : {"a.swl.new", "a.swl.new-journal", "a.swl.part"}) {
    EXPECT_TRUE(std::filesystem::is_symlink(folder / name)) << name;
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 5)
      << "and leaves none but the map";
}

TEST(MapFileNames, the_logs_of_another_database_are_neither_deleted_nor_replayed) {
  for (const char* suffix : {"-wal", "-journal", "-shm"}) {
    for (const bool has_other : {false, true}) {
      const TempFolder folder;
      if (has_other) test::write_file(folder / "a.swl", "no map of ours");
      const std::string log = std::string("a.swl") + suffix;
      test::write_file(folder / log, "content of another database");
      const auto refused = BlockStore::create(folder / "a.swl", 0.1, {.overwrite = true});
      ASSERT_FALSE(refused.has_value()) << log;
      EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
      EXPECT_NE(refused.error().text().find(log), std::string::npos) << refused.error().text();
      EXPECT_EQ(test::content_of(folder / log), "content of another database");
      MapFile::remove(folder / "a.swl");
      EXPECT_EQ(test::content_of(folder / log), "content of another database");
    }
  }
}

}  // namespace
}  // namespace swiftlet
