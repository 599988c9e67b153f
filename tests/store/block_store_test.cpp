// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/stream/block_store.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>
#include <unordered_map>

#include "store/store_support.hpp"

namespace swiftlet {
namespace {

using namespace std::chrono_literals;
using test::Blocks;
using test::Random;
using test::TempFolder;

std::unique_ptr<BlockStore> make_store(const std::filesystem::path& path,
                                       BlockStoreOptions options = {}) {
  auto store = BlockStore::create(path, 0.1, options);
  EXPECT_TRUE(store.has_value()) << (store ? "" : store.error().text());
  return std::move(*store);
}

/// Waits until one more batch has been committed that began after this call.
void wait_for_batch(const BlockStore& store) {
  const std::uint64_t now = store.stats().batches;
  while (store.stats().batches < now + 2) std::this_thread::sleep_for(1ms);
}

/// Changes a few random voxels of the window, as a frame does.
void change_some(RollingMap& map, Random& random, int blocks) {
  const BlockWindow& w = map.window();
  for (int i = 0; i < blocks; ++i) {
    const BlockIndex b{w.first.x + random.integer(0, w.size.x - 1),
                       w.first.y + random.integer(0, w.size.y - 1),
                       w.first.z + random.integer(0, w.size.z - 1)};
    map.writable(b).voxels[static_cast<std::size_t>(random.integer(0, 511))] =
        static_cast<QuantizedLogOdds>(random.integer(0, 255));
  }
}

TEST(BlockStore, loading_a_saved_map_gives_the_map) {
  TempFolder folder;
  Random random;
  for (int round = 0; round < 5; ++round) {
    RollingMap map = test::small_map();
    map.recentre(random.vector(-50, 50), nullptr);
    change_some(map, random, random.integer(0, 200));
    const auto snapshot = map.snapshot({7});
    ASSERT_TRUE(save_map(folder / "a.swl", *snapshot, true, {{"config", "voxel: 1\n"}}));
    EXPECT_EQ(test::blocks_in(folder / "a.swl"), test::blocks_in(*snapshot)) << random.repeat();
    const auto loaded = load_map(folder / "a.swl");
    EXPECT_EQ(loaded->voxel_m(), 0.1);
    EXPECT_EQ(loaded->frames(), 7U);
    EXPECT_EQ(loaded->meta().at("config"), "voxel: 1\n");
    EXPECT_TRUE(check_map(folder / "a.swl").empty());
  }
}

TEST(BlockStore, saving_twice_gives_the_same_bytes) {
  TempFolder folder;
  Random random;
  RollingMap map = test::small_map();
  map.recentre({0, 0, 0}, nullptr);
  change_some(map, random, 100);
  const auto snapshot = map.snapshot({1});
  ASSERT_TRUE(save_map(folder / "a.swl", *snapshot));
  ASSERT_TRUE(save_map(folder / "b.swl", *snapshot));
  EXPECT_EQ(test::bytes_of(folder / "a.swl"), test::bytes_of(folder / "b.swl"));
}

TEST(BlockStore, leaves_one_single_file_at_close) {
  TempFolder folder;
  auto store = make_store(folder / "a.swl");
  store->evict({1, 2, 3}, test::block_full_of(9), 1);
  ASSERT_TRUE(store->close());
  const std::filesystem::directory_iterator files(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1);
  EXPECT_EQ(test::blocks_in(folder / "a.swl"), (Blocks{{{1, 2, 3}, test::block_full_of(9)}}));
}

TEST(BlockStore, gives_back_bit_for_bit_from_memory_from_cache_and_from_disk) {
  TempFolder folder;
  Random random;
  auto store = make_store(folder / "a.swl", {.batch_interval = 5ms});
  const BlockIndex index{3, 0, 0};
  const VoxelBlock block = test::random_block(random);
  VoxelBlock back;
  EXPECT_FALSE(store->restore(index, back));

  store->evict(index, block, 1);
  EXPECT_TRUE(store->restore(index, back));
  EXPECT_EQ(back, block);

  wait_for_batch(*store);
  EXPECT_TRUE(store->restore(index, back));
  EXPECT_EQ(back, block);
  EXPECT_EQ(store->stats().restored_from_disk, 1U);

  store->expect_around({{0, 0, 0}, {3, 1, 1}});  // the block is next to this window
  const auto give_up = std::chrono::steady_clock::now() + 5s;
  while (store->stats().restored_from_cache == 0 && std::chrono::steady_clock::now() < give_up) {
    ASSERT_TRUE(store->restore(index, back));
    ASSERT_EQ(back, block);
  }
  EXPECT_GT(store->stats().restored_from_cache, 0U);
}

TEST(BlockStore, a_block_changed_after_it_was_read_ahead_comes_back_changed) {
  TempFolder folder;
  Random random;
  auto store = make_store(folder / "a.swl", {.batch_interval = 1ms});
  VoxelBlock back;
  for (std::uint64_t round = 1; round <= 200; ++round) {
    const VoxelBlock block = test::random_block(random);
    store->evict({3, 0, 0}, block, round);
    store->expect_around({{0, 0, 0}, {3, 1, 1}});
    if (random.chance(0.5)) std::this_thread::yield();
    if (random.chance(0.1)) wait_for_batch(*store);
    ASSERT_TRUE(store->restore({3, 0, 0}, back));
    ASSERT_EQ(back, block) << "round " << round << "; " << random.repeat();
  }
}

// Model test: the window wanders at random over a world that a hash map remembers whole.
TEST(BlockStore, a_window_that_wanders_finds_everything_as_it_left_it) {
  TempFolder folder;
  Random random;
  auto store = make_store(folder / "a.swl", {.batch_interval = 2ms, .pending_blocks = 64});
  RollingMap map = test::small_map();
  store->follow(map.reader());
  std::unordered_map<BlockIndex, VoxelBlock, BlockHash> world;
  Eigen::Vector3d p(0, 0, 0);
  for (std::uint64_t frame = 1; frame <= 600; ++frame) {
    p += random.vector(-1.0, 1.0);
    p = p.cwiseMax(-5.0).cwiseMin(5.0);
    map.recentre(p, store.get());
    for_each_block(map.window(), [&](const BlockIndex& index) {
      const auto known = world.find(index);
      const VoxelBlock* block = map.find(index);
      ASSERT_EQ(block != nullptr, known != world.end()) << frame << "; " << random.repeat();
      if (block == nullptr) return;
      ASSERT_EQ(*block, known->second) << frame << "; " << random.repeat();
    });
    change_some(map, random, 10);
    map.for_each_known_block([&](const BlockIndex& i, const VoxelBlock& b) { world[i] = b; });
    map.publish({frame});
  }
  const BlockStoreStats stats = store->stats();
  EXPECT_EQ(stats.restore_failed, 0U);
  EXPECT_EQ(stats.lost, 0U);
  ASSERT_TRUE(store->close(map.snapshot({600})));
  EXPECT_EQ(test::blocks_in(folder / "a.swl"), Blocks(world.begin(), world.end()))
      << random.repeat();
}

TEST(BlockStore, a_corridor_there_and_back_restores_every_block_that_was_evicted) {
  TempFolder folder;
  Random random;
  auto store = make_store(folder / "a.swl", {.batch_interval = 5ms});
  RollingMap map = test::small_map();
  store->follow(map.reader());
  std::unordered_map<BlockIndex, VoxelBlock, BlockHash> there;
  std::uint64_t frame = 0;
  for (int step = 0; step <= 300; ++step) {  // 60 m
    map.recentre({0.2 * step, 0, 0}, store.get());
    change_some(map, random, 20);
    map.for_each_known_block([&](const BlockIndex& i, const VoxelBlock& b) { there[i] = b; });
    map.publish({++frame});
  }
  std::size_t compared = 0;
  for (int step = 300; step >= 0; --step) {
    map.recentre({0.2 * step, 0, 0}, store.get());
    map.for_each_known_block([&](const BlockIndex& index, const VoxelBlock& block) {
      ++compared;
      ASSERT_EQ(block, there.at(index)) << random.repeat();
    });
    map.publish({++frame});
  }
  EXPECT_GT(compared, there.size());
  // The window and its snapshots, with some words of book-keeping a block; the path has 10 times
  // more.
  const std::size_t limit = map.window().block_count() * (1 + SnapshotStore::kSlots) * 600;
  EXPECT_LE(map.memory_bytes(), limit);
  EXPECT_GT(there.size() * sizeof(VoxelBlock), limit);
}

TEST(BlockStore, never_exceeds_the_cap_and_drops_the_oldest_first) {
  TempFolder folder;
  Random random;
  constexpr std::uint64_t kCap = 256 * 1024;
  auto store = make_store(folder / "a.swl", {.max_bytes = kCap, .batch_interval = 2ms});
  RollingMap map = test::small_map();
  store->follow(map.reader());
  Blocks world;
  std::atomic<bool> is_done = false;
  std::uint64_t largest = 0;
  std::thread watcher([&] {
    while (!is_done) largest = std::max(largest, std::filesystem::file_size(folder / "a.swl"));
  });
  std::uint64_t frame = 0;
  for (int step = 0; step < 150; ++step) {
    map.recentre({0.8 * step, 0, 0}, store.get());
    for_each_block(map.window(), [&](const BlockIndex& index) {
      if (map.find(index) == nullptr) map.writable(index) = test::random_block(random);
    });
    map.for_each_known_block([&](const BlockIndex& i, const VoxelBlock& b) { world[i] = b; });
    map.publish({++frame});
    wait_for_batch(*store);
  }
  EXPECT_GT(store->stats().dropped_by_cap, 0U);
  ASSERT_TRUE(store->close(map.snapshot({frame})));
  is_done = true;
  watcher.join();
  EXPECT_LE(largest, kCap);
  EXPECT_LE(std::filesystem::file_size(folder / "a.swl"), kCap);
  EXPECT_GT(std::filesystem::file_size(folder / "a.swl"), kCap - 80 * 1024) << "the cap is used";

  const Blocks kept = test::blocks_in(folder / "a.swl");
  EXPECT_EQ(kept.size(), store->stats().blocks_stored);
  EXPECT_EQ(kept.size() + store->stats().dropped_by_cap, world.size());
  // The flight went along x and each slab was touched at one time: what is kept is the end of it.
  std::int32_t first_kept = 1 << 30;
  for (const auto& [index, block] : kept) {
    EXPECT_EQ(block, world.at(index));
    first_kept = std::min(first_kept, index.x);
  }
  for (const auto& [index, block] : world) {
    const bool is_newer = index.x > first_kept;
    EXPECT_TRUE(!is_newer || kept.contains(index)) << index.x << ", " << first_kept;
  }
  EXPECT_TRUE(check_map(folder / "a.swl").empty());
}

TEST(BlockStore, policy_drop_keeps_the_window_and_nothing_else) {
  TempFolder folder;
  Random random;
  auto store = make_store(folder / "a.swl", {.policy = StorePolicy::kDrop, .batch_interval = 2ms});
  RollingMap map = test::small_map();
  store->follow(map.reader());
  std::uint64_t frame = 0;
  for (int step = 0; step < 40; ++step) {
    const auto shift =
        map.recentre({step < 20 ? 0.4 * step : 0.4 * (40 - step), 0, 0}, store.get());
    EXPECT_EQ(shift.blocks_restored, 0U);
    change_some(map, random, 10);
    map.publish({++frame});
    if (step % 10 == 5) wait_for_batch(*store);
  }
  const auto last = map.snapshot({frame});
  ASSERT_TRUE(store->close(last));
  EXPECT_EQ(test::blocks_in(folder / "a.swl"), test::blocks_in(*last)) << random.repeat();
}

TEST(BlockStore, a_map_can_be_read_while_it_is_written) {
  TempFolder folder;
  Random random;
  auto store = make_store(folder / "a.swl", {.batch_interval = 1ms});
  std::atomic<bool> is_done = false;
  std::thread flight([&] {
    for (std::uint64_t i = 1; !is_done; ++i) {
      const auto x = static_cast<std::int32_t>(i % 500);
      store->evict({x, 0, 0}, test::block_full_of(x % 256), i);
    }
  });
  for (int i = 0; i < 20; ++i) {
    for (const auto& [index, block] : test::blocks_in(folder / "a.swl")) {
      EXPECT_EQ(block, test::block_full_of(index.x % 256));
    }
  }
  is_done = true;
  flight.join();
}

}  // namespace
}  // namespace swiftlet
