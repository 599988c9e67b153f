// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// A writer that is killed at each of its operations on the disk, one after the other, and readers
// of what it leaves: with all rights, and with none but to read.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <functional>

#include "store/faulty_disk.hpp"
#include "store/store_support.hpp"

namespace swiftlet {
namespace {

using test::TempFolder;

/// Runs in a child; its exit code, or minus the signal that killed it.
int in_child(const std::function<int()>& work) {
  const pid_t child = fork();
  if (child == 0) _exit(work());
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

int write_small_map(const std::filesystem::path& path, int kill_at) {
  test::FaultyDisk disk;
  disk.kill_at = kill_at;
  auto store = BlockStore::create(path, 0.1, {}, {{"source", "test"}});
  if (!store) return 1;
  for (int i = 0; i < 8; ++i) (*store)->evict({i, 0, 0}, test::block_full_of(i), 1);
  return (*store)->close() ? 0 : 2;
}

/// 0 if the map can be opened and read to its end.
int read_whole(const std::filesystem::path& path) {
  auto map = load_map(path);
  if (!map) {
    std::fprintf(stderr, "%s\n", map.error().text().c_str());
    return 1;
  }
  int blocks = 0;
  auto read = map->for_each_block([&](const BlockIndex& index, const VoxelBlock& block) -> Status {
    blocks += block == test::block_full_of(index.x) ? 1 : 100;
    return Done{};
  });
  if (!read) return 2;
  return blocks == 0 || blocks == 8 ? 0 : 3;
}

/// As read_whole(), by a user who may write neither the map nor its folder.
int read_whole_as_a_stranger(const std::filesystem::path& path) {
  using std::filesystem::perms;
  const auto folder = path.parent_path();
  std::filesystem::permissions(folder, perms::owner_read | perms::owner_exec | perms::group_read |
                                           perms::group_exec | perms::others_read |
                                           perms::others_exec);
  const int code = in_child([&] {
    constexpr uid_t kNobody = 65534;
    if (geteuid() == 0 && setuid(kNobody) != 0) return 10;
    return read_whole(path);
  });
  std::filesystem::permissions(folder, perms::owner_all);
  return code;
}

TEST(CutOffWriter, leaves_what_every_reader_opens_wherever_it_is_killed) {
  int kills = 0, with_journal = 0, with_log = 0;
  for (;; ++kills) {
    ASSERT_LT(kills, 500) << "the writer never ends";
    const TempFolder folder;
    const auto path = folder / "a.swl";
    const int code = in_child([&] { return write_small_map(path, kills); });
    ASSERT_TRUE(code == 0 || code == -SIGKILL) << code << " at operation " << kills;
    if (!std::filesystem::exists(path)) {
      ASSERT_NE(code, 0);
      continue;  // nothing was ever committed
    }
    with_journal += std::filesystem::exists(folder / "a.swl-journal") ? 1 : 0;
    with_log += std::filesystem::exists(folder / "a.swl-wal") ? 1 : 0;
    const auto before = test::bytes_of(path);
    ASSERT_EQ(read_whole_as_a_stranger(path), 0) << "read-only, operation " << kills;
    ASSERT_EQ(in_child([&] { return read_whole(path); }), 0) << "operation " << kills;
    ASSERT_TRUE(check_map(path).empty()) << "operation " << kills;
    EXPECT_EQ(test::bytes_of(path), before) << "a reader has changed the map";
    EXPECT_FALSE(MapFile::writer_of(path).has_value());
    if (code == 0) break;
    // A map that is replaced or set aside takes what belongs to it along, or goes with it.
    ASSERT_TRUE(MapFile::rename(path, folder / "b.swl"));
    ASSERT_EQ(read_whole(folder / "b.swl"), 0) << "renamed, operation " << kills;
    ASSERT_TRUE(save_map(folder / "b.swl", *test::small_map().snapshot({1}), true));
    ASSERT_TRUE(test::blocks_in(folder / "b.swl").empty());
  }
  EXPECT_GT(with_journal, 0) << "the cases that once could not be opened";
  EXPECT_GT(with_log, 0);
}

TEST(CutOffWriter, is_read_from_a_copy_of_which_nothing_is_left) {
  const TempFolder folder;
  int at = 0;
  for (; at < 500 && !std::filesystem::exists(folder / "a.swl-journal"); ++at) {
    MapFile::remove(folder / "a.swl");
    in_child([&] { return write_small_map(folder / "a.swl", at); });
  }
  ASSERT_LT(at, 500);
  // A folder for temporary files that no other test uses, known to the child alone.
  std::filesystem::create_directory(folder / "tmp");
  const int code = in_child([&] {
    setenv("TMPDIR", (folder / "tmp").c_str(), 1);
    const auto map = load_map(folder / "a.swl");
    return !map ? 1 : std::filesystem::is_empty(folder / "tmp") ? 0 : 2;
  });
  EXPECT_EQ(code, 0) << "1: not read, 2: the copy is left while the map is open";
  EXPECT_TRUE(std::filesystem::exists(folder / "a.swl-journal")) << "a reader changes nothing";
}

/// A journal may name a file that SQLite deletes when it has been played back.
TEST(CutOffWriter, a_journal_that_names_another_file_cannot_have_it_deleted) {
  const TempFolder folder;
  test::write_file(folder / "victim", "x");
  int at = 0;
  for (; at < 500 && !std::filesystem::exists(folder / "a.swl-journal"); ++at) {
    MapFile::remove(folder / "a.swl");
    in_child([&] { return write_small_map(folder / "a.swl", at); });
  }
  const std::string name = (folder / "victim").string();
  std::string tail(4, '\0');  // the page of the lock byte: where SQLite writes such a name
  tail += name;
  const auto add = [&](std::uint32_t v) {
    for (int shift = 24; shift >= 0; shift -= 8) tail += static_cast<char>(v >> shift & 0xffU);
  };
  std::uint32_t sum = 0;
  for (const char c : name) sum += static_cast<std::uint32_t>(c);
  add(static_cast<std::uint32_t>(name.size()));
  add(sum);
  tail += "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  const auto journal = folder / "a.swl-journal";
  test::write_file(folder / "j", test::content_of(journal) + tail);
  std::filesystem::rename(folder / "j", journal);
  (void)load_map(folder / "a.swl");
  EXPECT_TRUE(std::filesystem::exists(folder / "victim"));
}

}  // namespace
}  // namespace swiftlet
