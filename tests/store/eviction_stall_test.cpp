// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What happens when blocks leave the window faster than the disk takes them: the mapping thread
// waits, which is counted, and no block is lost.

#include <gtest/gtest.h>

#include "store/store_support.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/store/stream/block_store.hpp"

namespace swiftlet {
namespace {

using namespace std::chrono_literals;

TEST(EvictionStall, a_full_buffer_waits_for_the_disk_is_counted_and_loses_nothing) {
  constexpr std::int32_t kBlocks = 2000;
  test::TempFolder folder;
  auto store =
      BlockStore::create(folder / "a.swl", 0.1, {.batch_interval = 1s, .pending_blocks = 8});
  ASSERT_TRUE(store);
  for (std::int32_t i = 0; i < kBlocks; ++i)
    (*store)->evict({i, 0, 0}, test::block_full_of(1 + i % 250), 1);
  ASSERT_TRUE((*store)->close());
  EXPECT_GT((*store)->stats().stalls, 0U);
  EXPECT_EQ((*store)->stats().lost, 0U);
  const auto blocks = test::blocks_in(folder / "a.swl");
  ASSERT_EQ(blocks.size(), static_cast<std::size_t>(kBlocks));
  EXPECT_EQ(blocks.at({7, 0, 0}), test::block_full_of(8));
}

// With room for a second's worth of blocks there is nothing to wait for.
TEST(EvictionStall, a_buffer_with_room_never_waits) {
  test::TempFolder folder;
  auto store =
      BlockStore::create(folder / "a.swl", 0.1, {.batch_interval = 1s, .pending_blocks = 1024});
  ASSERT_TRUE(store);
  for (std::int32_t i = 0; i < 400; ++i) (*store)->evict({i, 0, 0}, test::block_full_of(9), 1);
  EXPECT_EQ((*store)->stats().stalls, 0U);
  ASSERT_TRUE((*store)->close());
}

}  // namespace
}  // namespace swiftlet
