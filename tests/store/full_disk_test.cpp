// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <gtest/gtest.h>
#include <sys/mount.h>

#include <chrono>
#include <cstring>
#include <thread>

#include "store/faulty_disk.hpp"
#include "store/store_support.hpp"

namespace swiftlet {
namespace {

using namespace std::chrono_literals;
using test::Random;
using test::TempFolder;

constexpr std::size_t kPending = 64;

/// Offers blocks until `is_enough` says so or a minute has passed.
template <class IsEnough>
int evict_until(BlockStore& store, Random& random, int first, IsEnough&& is_enough) {
  const auto end = std::chrono::steady_clock::now() + 60s;
  int i = first;
  for (; !is_enough(store.stats()) && std::chrono::steady_clock::now() < end; ++i) {
    store.evict({i, 0, 0}, test::random_block(random), static_cast<std::uint64_t>(i));
    if (i % 64 == 0) std::this_thread::sleep_for(1ms);
  }
  EXPECT_TRUE(is_enough(store.stats()));
  return i;
}

TEST(FullStore, goes_on_counts_what_is_lost_and_writes_again_when_there_is_room) {
  const TempFolder folder;
  Random random;
  test::FaultyDisk disk;
  auto store =
      BlockStore::create(folder / "a.swl", 0.1, {.batch_interval = 1ms, .pending_blocks = kPending})
          .value();
  int next = evict_until(*store, random, 0, [](const auto& s) { return s.written > 100; });
  disk.room = 0;
  next = evict_until(*store, random, next, [](const auto& s) { return s.lost > 1000; });
  const BlockStoreStats full = store->stats();
  ASSERT_TRUE(full.error.has_value());
  EXPECT_EQ(full.error->code, ErrorCode::kIo);
  EXPECT_GT(full.refused_batches, 0U);

  disk.room = std::numeric_limits<std::int64_t>::max();
  const auto is_writing = [&](const BlockStoreStats& s) { return s.batches > full.batches + 1; };
  next = evict_until(*store, random, next, is_writing);
  EXPECT_FALSE(store->stats().error.has_value()) << "it is over";
  const auto closed = store->close();
  ASSERT_FALSE(closed.has_value()) << "but what was lost is told at the end";
  const BlockStoreStats end = store->stats();
  EXPECT_NE(closed.error().what.find(std::to_string(end.lost) + " blocks"), std::string::npos)
      << closed.error().text();
  EXPECT_EQ(end.evicted, static_cast<std::uint64_t>(next));
  EXPECT_EQ(test::blocks_in(folder / "a.swl").size(), end.evicted - end.lost) << random.repeat();
  EXPECT_TRUE(check_map(folder / "a.swl").empty());
}

TEST(FullStore, tries_less_and_less_often) {
  const TempFolder folder;
  Random random;
  test::FaultyDisk disk;
  auto store = BlockStore::create(folder / "a.swl", 0.1, {.batch_interval = 1ms}).value();
  store->evict({1, 0, 0}, test::random_block(random), 1);
  disk.room = 0;
  while (store->stats().refused_batches < 3) std::this_thread::sleep_for(1ms);
  std::this_thread::sleep_for(300ms);
  EXPECT_LT(store->stats().refused_batches, 20U) << "1, 2, 4, ... ms, not every millisecond";
}

TEST(FullStore, takes_at_its_end_whatever_finds_room) {
  const TempFolder folder;
  Random random;
  test::FaultyDisk disk;
  auto store = BlockStore::create(folder / "a.swl", 0.1, {.batch_interval = 1000ms}).value();
  for (int i = 0; i < 1000; ++i) store->evict({i, 0, 0}, test::random_block(random), 1);
  disk.room = 300 * 1024;  // about half of it, then the log cannot be folded in
  const auto closed = store->close();
  ASSERT_FALSE(closed.has_value());
  const auto found = test::blocks_in(folder / "a.swl");
  EXPECT_GT(found.size(), 100U);
  EXPECT_LT(found.size(), 1000U);
  EXPECT_EQ(found.size() + store->stats().lost, 1000U);
  EXPECT_TRUE(check_map(folder / "a.swl").empty());
}

/// The same on a real disk that is full.
TEST(FullStore, stays_sound_on_a_real_disk_of_one_megabyte) {
  const TempFolder folder;
  if (mount("tmpfs", folder.path().c_str(), "tmpfs", 0, "size=1m") != 0) {
    GTEST_SKIP() << "no small disk can be mounted here: " << std::strerror(errno);
  }
  Random random;
  {
    auto store = BlockStore::create(folder / "a.swl", 0.1,
                                    {.batch_interval = 1ms, .pending_blocks = kPending})
                     .value();
    evict_until(*store, random, 0, [](const auto& s) { return s.lost > 1000; });
    EXPECT_FALSE(store->close());
    EXPECT_TRUE(check_map(folder / "a.swl").empty());
    const BlockStoreStats end = store->stats();
    EXPECT_EQ(test::blocks_in(folder / "a.swl").size(), end.evicted - end.lost);
  }
  umount2(folder.path().c_str(), MNT_DETACH);
}

}  // namespace
}  // namespace swiftlet
