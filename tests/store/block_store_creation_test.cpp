// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>

#include "store/store_support.hpp"
#include "support/no_threads.hpp"

namespace swiftlet {
namespace {

using namespace std::chrono_literals;
using test::TempFolder;

TEST(BlockStoreCreation, refuses_to_overwrite_unless_told_and_then_starts_empty) {
  TempFolder folder;
  {
    auto store = BlockStore::create(folder / "a.swl", 0.1).value();
    store->evict({1, 2, 3}, test::block_full_of(9), 1);
  }
  const auto before = test::bytes_of(folder / "a.swl");
  const auto refused = BlockStore::create(folder / "a.swl", 0.1);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::kUsage);
  EXPECT_EQ(test::bytes_of(folder / "a.swl"), before);
  auto store = BlockStore::create(folder / "a.swl", 0.1, {.overwrite = true});
  ASSERT_TRUE(store.has_value());
  ASSERT_TRUE((*store)->close());
  EXPECT_TRUE(test::blocks_in(folder / "a.swl").empty());
}

TEST(BlockStoreCreation, a_map_has_its_description_as_soon_as_it_has_its_name) {
  TempFolder folder;  // so a writer that is killed before its first batch leaves a valid map
  const MapMeta meta{{"voxel_m", "0.1"}, {"frames", "0"}, {"source", "somewhere"}};
  ASSERT_TRUE(MapFile::create(folder / "a.swl", false, meta));
  EXPECT_TRUE(check_map(folder / "a.swl").empty());
  const auto map = load_map(folder / "a.swl");
  ASSERT_TRUE(map.has_value()) << map.error().text();
  EXPECT_EQ(map->meta(), meta);
  EXPECT_EQ(map->block_count(), 0U);
}

TEST(BlockStoreCreation, says_where_it_cannot_write) {
  for (const char* place : {"/proc/a.swl", "/nowhere/at/all/a.swl"}) {
    const auto store = BlockStore::create(place, 0.1);
    ASSERT_FALSE(store.has_value()) << place;
    EXPECT_EQ(store.error().code, ErrorCode::kIo);
    EXPECT_NE(store.error().text().find(place), std::string::npos) << store.error().text();
    EXPECT_FALSE(store.error().remedy.empty());
  }
}

TEST(CutOffMap, without_its_log_is_read_and_nothing_is_left_beside_it) {
  TempFolder folder;
  const auto store = BlockStore::create(folder / "a.swl", 0.1).value();
  std::filesystem::create_directory(folder / "b");
  const auto copy = folder / "b" / "a.swl";
  std::filesystem::copy_file(folder / "a.swl", copy);
  EXPECT_TRUE(check_map(copy).empty());
  {
    const auto map = load_map(copy);
    ASSERT_TRUE(map.has_value()) << map.error().text();
    EXPECT_EQ(map->block_count(), 0U);
  }
  const std::filesystem::directory_iterator files(folder / "b");
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
}

#ifdef SWIFTLET_CAN_LACK_THREADS
TEST(BlockStoreCreation, says_so_and_leaves_nothing_if_the_system_has_no_thread_for_it) {
  TempFolder folder;
  const test::NoThreads none;
  const auto store =
      BlockStore::create(folder / "a.swl", 0.1, {.pending_blocks = 16, .cache_blocks = 16});
  ASSERT_FALSE(store.has_value());
  EXPECT_EQ(store.error().code, ErrorCode::kOutOfMemory);
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}
#endif

TEST(BlockStoreCreation, refuses_options_that_cannot_be_meant) {
  TempFolder folder;
  for (const BlockStoreOptions& bad :
       {BlockStoreOptions{.max_bytes = 1000}, BlockStoreOptions{.batch_interval = 0ms},
        BlockStoreOptions{.batch_interval = 1001ms}, BlockStoreOptions{.pending_blocks = 0}}) {
    const auto store = BlockStore::create(folder / "a.swl", 0.1, bad);
    ASSERT_FALSE(store.has_value());
    EXPECT_EQ(store.error().code, ErrorCode::kInvalidConfig);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.swl"));
  }
}

}  // namespace
}  // namespace swiftlet
