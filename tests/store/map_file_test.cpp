// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <algorithm>

#include "store/store_support.hpp"
#include "swiftlet/query/voxel_counts.hpp"
#include "swiftlet/store/map_loader.hpp"

namespace swiftlet {
namespace {

using test::Blocks;
using test::Random;
using test::TempFolder;

/// A map of a few hundred blocks, as a flight leaves it.
Blocks write_map(const std::filesystem::path& path, Random& random) {
  Blocks blocks;
  auto store = BlockStore::create(path, 0.1, {}, {{"config", "map:\n  voxel_m: 0.1\n"}});
  for (int i = 0; i < 150; ++i) {
    const BlockIndex index{random.integer(-9, 9), random.integer(-9, 9), random.integer(-2, 2)};
    blocks[index] = i % 3 == 0 ? test::random_block(random) : test::block_full_of(i);
    (*store)->evict(index, blocks[index], static_cast<std::uint64_t>(i));
  }
  EXPECT_TRUE((*store)->close());
  return blocks;
}

/// A damaged file is an error or gives the untouched content; anything else is a failure.
::testing::AssertionResult is_noticed_or_harmless(const std::filesystem::path& path,
                                                  const Blocks& truth, bool& is_noticed) {
  is_noticed = !check_map(path).empty();
  auto map = load_map(path);
  if (!map) return ::testing::AssertionSuccess();
  Blocks found;
  auto read = map->for_each_block([&](const BlockIndex& index, const VoxelBlock& b) -> Status {
    found[index] = b;
    return Done{};
  });
  for (const auto& [index, block] : found) {  // also those before the error
    const auto known = truth.find(index);
    if (known == truth.end() || known->second != block) {
      return ::testing::AssertionFailure() << "handed out a wrong block";
    }
  }
  if (!read) return ::testing::AssertionSuccess();
  if (found == truth && map->voxel_m() == 0.1 &&
      map->meta().at("config") == "map:\n  voxel_m: 0.1\n") {
    return ::testing::AssertionSuccess();
  }
  return ::testing::AssertionFailure() << "passed a map that is not the one that was saved";
}

TEST(MapFile, every_truncated_file_is_refused) {
  TempFolder folder;
  Random random;
  write_map(folder / "a.swl", random);
  const auto whole = test::bytes_of(folder / "a.swl");
  for (int i = 0; i < 120; ++i) {
    const int size = static_cast<int>(whole.size());
    const int length = i < 20   ? i * 7
                       : i < 40 ? (i - 20) * 4096 % size
                                : random.integer(0, size - 1);
    test::write_bytes(folder / "b.swl", {whole.begin(), whole.begin() + length});
    EXPECT_FALSE(check_map(folder / "b.swl").empty()) << length << " of " << size;
  }
}

TEST(MapFile, no_flipped_bit_gives_a_wrong_block_or_a_crash) {
  TempFolder folder;
  Random random;
  const Blocks truth = write_map(folder / "a.swl", random);
  const auto whole = test::bytes_of(folder / "a.swl");
  int noticed = 0;
  constexpr int kRounds = 500;
  for (int i = 0; i < kRounds; ++i) {
    const int size = static_cast<int>(whole.size());
    // All of the file's header, the headers of the pages, and anywhere.
    const int at = i < 100   ? i
                   : i < 250 ? random.integer(0, size / 4096 - 1) * 4096 + random.integer(0, 200)
                             : random.integer(0, size - 1);
    auto damaged = whole;
    const auto byte = static_cast<std::size_t>(at);
    damaged[byte] = static_cast<char>(damaged[byte] ^ (1 << random.integer(0, 7)));
    test::write_bytes(folder / "b.swl", damaged);
    bool is_noticed = false;
    ASSERT_TRUE(is_noticed_or_harmless(folder / "b.swl", truth, is_noticed))
        << "byte " << at << "; " << random.repeat();
    noticed += is_noticed ? 1 : 0;
    for (const char* left : {"b.swl-wal", "b.swl-shm", "b.swl-journal"}) {
      std::filesystem::remove(folder / left);
    }
  }
  EXPECT_GT(noticed, kRounds / 3) << "most of the file is content";
}

void run_sql(const std::filesystem::path& path, const char* sql) {
  sqlite3* db = nullptr;
  ASSERT_EQ(sqlite3_open(path.c_str(), &db), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(db, sql, nullptr, nullptr, nullptr), SQLITE_OK) << sqlite3_errmsg(db);
  sqlite3_close(db);
}

TEST(MapFile, notices_every_change_that_sqlite_itself_calls_sound) {
  Random random;
  for (const char* change :
       {"UPDATE blocks SET x = x + 100 WHERE z = 0", "UPDATE blocks SET touched = touched + 1",
        "DELETE FROM blocks WHERE (x, y, z) IN (SELECT x, y, z FROM blocks LIMIT 1)",
        "UPDATE meta SET value = '0.2' WHERE key = 'voxel_m'", "DELETE FROM meta",
        "DELETE FROM seal", "UPDATE seal SET blocks = blocks - 1", "DROP TABLE meta"}) {
    TempFolder folder;
    write_map(folder / "a.swl", random);
    ASSERT_TRUE(check_map(folder / "a.swl").empty());
    run_sql(folder / "a.swl", change);
    EXPECT_FALSE(check_map(folder / "a.swl").empty()) << change;
  }
}

// tests/golden/map_0.1.0.swl is of the program of version 0.1.0: what is on disk keeps its names.
TEST(MapFile, that_an_earlier_program_wrote_is_read) {
  const std::filesystem::path path = SWIFTLET_SOURCE_DIR "/tests/golden/map_0.1.0.swl";
  EXPECT_TRUE(check_map(path).empty());
  const auto map = load_map(path);
  ASSERT_TRUE(map) << map.error().text();
  EXPECT_EQ(map->frames(), 7U);
  const auto whole = read_whole_map(*map);
  ASSERT_TRUE(whole) << whole.error().text();
  EXPECT_EQ(whole->voxel_m(), 0.1);
  EXPECT_EQ(whole->block_count(), 40U);
  EXPECT_EQ(count_voxels(*whole), (VoxelCounts{3584, 16896, 0}));
  EXPECT_EQ(whole->header().start_m, Eigen::Vector3d(0, 1, 2));
}

TEST(MapFile, refuses_a_newer_version_by_name) {
  TempFolder folder;
  Random random;
  write_map(folder / "a.swl", random);
  run_sql(folder / "a.swl", "PRAGMA user_version = 7");
  const auto map = load_map(folder / "a.swl");
  ASSERT_FALSE(map.has_value());
  EXPECT_EQ(map.error().code, ErrorCode::kUnsupported);
  EXPECT_NE(map.error().what.find("version 7"), std::string::npos) << map.error().text();
}

TEST(MapFile, says_what_is_not_a_map) {
  TempFolder folder;
  run_sql(folder / "other.swl", "CREATE TABLE songs(name TEXT)");
  test::write_bytes(folder / "text.swl", std::vector<char>(5000, 'x'));
  test::write_bytes(folder / "empty.swl", {});
  std::filesystem::create_directory(folder / "folder.swl");
  for (const char* name : {"other.swl", "text.swl", "empty.swl", "folder.swl"}) {
    const auto map = load_map(folder / name);
    ASSERT_FALSE(map.has_value()) << name;
    EXPECT_EQ(map.error().code, ErrorCode::kCorruptInput) << name;
    EXPECT_NE(map.error().text().find(name), std::string::npos);
  }
  EXPECT_EQ(load_map(folder / "missing.swl").error().code, ErrorCode::kNotFound);
}

}  // namespace
}  // namespace swiftlet
