// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/map/rolling_map.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <deque>
#include <limits>
#include <thread>
#include <unordered_map>

#include "support/seeds.hpp"
#include "swiftlet/map/memory_archive.hpp"

namespace swiftlet {
namespace {

using test::Random;
using Model = std::unordered_map<VoxelIndex, QuantizedLogOdds, VoxelHash>;
using Blocks = std::unordered_map<BlockIndex, VoxelBlock, BlockHash>;

RollingMap small_map(const Eigen::Vector3d& size_m = {4.0, 3.0, 2.0}, double voxel_m = 0.1) {
  auto map =
      RollingMap::create({.voxel_m = voxel_m, .size_m = size_m, .trigger_m = {0.5, 0.5, 0.5}});
  EXPECT_TRUE(map) << map.error().text();
  return std::move(*map);
}

VoxelIndex random_voxel(Random& random, const BlockWindow& window) {
  const VoxelBox box = voxel_box(window);
  return {random.integer(box.first.x, box.last.x), random.integer(box.first.y, box.last.y),
          random.integer(box.first.z, box.last.z)};
}

void set(RollingMap& map, const VoxelIndex& voxel, QuantizedLogOdds value) {
  map.writable(block_of(voxel)).voxels[offset_in_block(voxel)] = value;
}

QuantizedLogOdds lookup(const Model& model, const VoxelIndex& voxel) {
  const auto found = model.find(voxel);
  return found == model.end() ? kUnknownVoxel : found->second;
}

/// What the map must do, in the plainest way: a hash map of voxels, and the rule of the trigger
/// box.
struct ModelMap {
  Model voxels;  // every voxel ever written, if the map keeps; else those of the window
  bool keeps;

  void forget_outside(const BlockWindow& window) {
    if (keeps) return;
    std::erase_if(voxels,
                  [&](const auto& entry) { return !window.contains(block_of(entry.first)); });
  }
};

struct HeldSnapshot {
  MapSnapshot snapshot;
  Model voxels;
  BlockWindow window;
};

void expect_same(const HeldSnapshot& held, Random& random) {
  ASSERT_EQ(held.snapshot.window(), held.window);
  for (const auto& [voxel, value] : held.voxels) {
    const QuantizedLogOdds expected = held.window.contains(block_of(voxel)) ? value : kUnknownVoxel;
    ASSERT_EQ(held.snapshot.log_odds(voxel), expected) << random.repeat();
  }
}

/// Random integrate / query / query-then-insert / shift / snapshot sequences against the model.
void run_model_test(bool keeps) {
  Random random;
  for (int run = 0; run < 12; ++run) {
    RollingMap map = small_map();
    MemoryArchive archive;
    BlockArchive* sink = keeps ? &archive : nullptr;
    ModelMap model{{}, keeps};
    std::deque<HeldSnapshot> held;
    Eigen::Vector3d p = Eigen::Vector3d::Zero();
    map.recentre(p, sink);

    for (int step = 0; step < 3000; ++step) {
      const double choice = random.real(0.0, 1.0);
      const VoxelIndex voxel = random_voxel(random, map.window());
      if (choice < 0.55) {
        const auto value = static_cast<QuantizedLogOdds>(random.integer(0, 255));
        set(map, voxel, value);
        model.voxels[voxel] = value;
      } else if (choice < 0.9) {
        ASSERT_EQ(map.log_odds(voxel), lookup(model.voxels, voxel)) << random.repeat();
        if (random.chance(0.5)) {
          set(map, voxel, 200);
          model.voxels[voxel] = 200;
        }
      } else if (choice < 0.97) {
        p += random.chance(0.05) ? random.vector(-30.0, 30.0) : random.vector(-0.7, 0.7);
        map.recentre(p, sink);
        model.forget_outside(map.window());
      } else {
        if (held.size() == 2) {
          expect_same(held.front(), random);
          held.pop_front();
        }
        auto snapshot = map.snapshot({static_cast<std::uint64_t>(step)});
        ASSERT_TRUE(snapshot);
        held.push_back({std::move(*snapshot), model.voxels, map.window()});
      }
      if (testing::Test::HasFatalFailure()) return;
    }
    for (const HeldSnapshot& h : held) expect_same(h, random);
    for (const auto& [index, value] : model.voxels) {
      if (map.window().contains(block_of(index))) {
        ASSERT_EQ(map.log_odds(index), value) << random.repeat();
      }
    }
  }
}

TEST(RollingMap, behaves_like_a_hash_map_of_voxels_that_forgets_what_leaves) {
  run_model_test(false);
}
TEST(RollingMap, behaves_like_a_hash_map_of_voxels_when_an_archive_keeps_what_leaves) {
  run_model_test(true);
}

TEST(RollingMap, covers_the_asked_for_box_around_the_vehicle_wherever_it_stopped) {
  Random random;
  RollingMap map = small_map();
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d p = random.vector(-50, 50);
    map.recentre(p, nullptr);
    for (const double side : {-0.999, 0.999}) {
      const Eigen::Vector3d corner = p + side * Eigen::Vector3d(2.0, 1.5, 1.0);
      ASSERT_TRUE(map.window().contains(block_of(voxel_containing(corner, 0.1))))
          << random.repeat();
    }
  }
}

TEST(RollingMap, stays_put_while_the_vehicle_is_inside_the_trigger_box) {
  RollingMap map = small_map();
  map.recentre({0.3, 0.3, 0.3}, nullptr);
  const BlockWindow window = map.window();
  for (const double d : {-0.49, 0.49}) {
    EXPECT_FALSE(map.recentre({0.3 + d, 0.3 - d, 0.3 + d}, nullptr).moved);
    EXPECT_EQ(map.window(), window);
  }
  EXPECT_TRUE(map.recentre({2.0, 0.3, 0.3}, nullptr).moved);
}

TEST(RollingMap, there_and_back_keeps_what_never_left_and_restores_the_rest_bit_for_bit) {
  Random random;
  RollingMap map = small_map();
  MemoryArchive archive;
  map.recentre(Eigen::Vector3d::Zero(), &archive);
  Blocks before;
  for_each_block(map.window(), [&](const BlockIndex& b) {
    if (random.chance(0.5)) return;
    VoxelBlock& block = map.writable(b);
    for (QuantizedLogOdds& voxel : block.voxels)
      voxel = static_cast<QuantizedLogOdds>(random.integer(0, 255));
    before[b] = block;
  });
  const auto away = map.recentre({3.0, -2.0, 0.0}, &archive);
  EXPECT_GT(away.blocks_evicted, 0U);
  const auto back = map.recentre(Eigen::Vector3d::Zero(), &archive);
  EXPECT_EQ(back.blocks_restored, away.blocks_evicted);
  for (const auto& [index, block] : before) ASSERT_EQ(*map.find(index), block) << random.repeat();
}

TEST(RollingMap, hands_each_block_that_leaves_to_the_archive_once_and_forgets_it) {
  RollingMap map = small_map();
  MemoryArchive archive;
  map.recentre(Eigen::Vector3d::Zero(), &archive);
  set(map, {0, 0, 0}, 250);
  const auto shift = map.recentre({100.0, 0.0, 0.0}, &archive);
  EXPECT_EQ(shift.blocks_evicted, 1U);
  EXPECT_EQ(archive.blocks().find({0, 0, 0})->voxels[0], 250);
  EXPECT_EQ(map.log_odds({0, 0, 0}), kUnknownVoxel);
}

TEST(RollingMap, uses_no_more_memory_for_a_longer_path) {
  RollingMap map = small_map();
  MemoryArchive archive;
  std::size_t after_one_lap = 0;
  for (int step = 0; step < 2000; ++step) {
    map.recentre({0.4 * step, 0.0, 0.0}, &archive);
    for_each_block(map.window(), [&](const BlockIndex& b) { map.writable(b).clear(); });
    if (step == 50) after_one_lap = map.memory_bytes();
  }
  EXPECT_EQ(map.memory_bytes(), after_one_lap);
}

TEST(RollingMap, refuses_options_that_make_no_map) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double voxel : {0.0, -0.1, nan, 1e-6}) {
    EXPECT_EQ(RollingMap::create({.voxel_m = voxel}).error().where, "map.voxel_m");
  }
  EXPECT_EQ(RollingMap::create({.voxel_m = 0.2, .size_m = {0.1, 20, 6}}).error().where,
            "map.size_m");
  EXPECT_EQ(RollingMap::create({.voxel_m = 0.2, .size_m = {nan, 20, 6}}).error().where,
            "map.size_m");
  const auto huge = RollingMap::create({.voxel_m = 0.01, .size_m = {200, 200, 200}});
  EXPECT_EQ(huge.error().code, ErrorCode::kInvalidConfig);
  EXPECT_NE(huge.error().what.find("GiB"), std::string::npos);
}

TEST(MapSnapshot, never_changes_while_the_writer_goes_on) {
  RollingMap map = small_map();
  map.recentre(Eigen::Vector3d::Zero(), nullptr);
  set(map, {1, 2, 3}, 10);
  const auto snapshot = map.snapshot({1});
  ASSERT_TRUE(snapshot);
  set(map, {1, 2, 3}, 99);
  map.recentre({50, 0, 0}, nullptr);
  map.publish({2});
  EXPECT_EQ(snapshot->log_odds({1, 2, 3}), 10);
  EXPECT_EQ(snapshot->frame_count(), 1U);
}

TEST(MapSnapshot, is_not_published_while_readers_hold_every_slot_and_again_when_one_lets_go) {
  RollingMap map = small_map();
  map.recentre(Eigen::Vector3d::Zero(), nullptr);
  std::vector<MapSnapshot> held;
  for (std::uint64_t i = 0; i < SnapshotStore::kSlots; ++i) {
    auto snapshot = map.snapshot({i});
    ASSERT_TRUE(snapshot);
    held.push_back(std::move(*snapshot));
  }
  EXPECT_FALSE(map.snapshot({9}));
  held.erase(held.begin());
  EXPECT_TRUE(map.snapshot({10}));
}

TEST(MapSnapshot, tells_blocks_that_changed_since_an_earlier_one) {
  RollingMap map = small_map();
  map.recentre(Eigen::Vector3d::Zero(), nullptr);
  set(map, {0, 0, 0}, 1);
  set(map, {8, 0, 0}, 1);
  const auto first = map.snapshot({1});
  set(map, {8, 0, 0}, 2);
  const auto second = map.snapshot({2});
  EXPECT_EQ(first->version({0, 0, 0}), second->version({0, 0, 0}));
  EXPECT_LT(first->version({1, 0, 0}), second->version({1, 0, 0}));
  EXPECT_EQ(second->version({0, 1, 0}), 0U);
}

// The writer gives all voxels of the window the number of the frame; a reader that sees two numbers
// in one snapshot has seen a frame half done.
TEST(MapReader, sees_whole_frames_only_from_several_threads) {
  RollingMap map = small_map({1.6, 1.6, 0.8});
  map.recentre(Eigen::Vector3d::Zero(), nullptr);
  std::atomic<bool> stop{false};
  std::atomic<int> torn{0}, seen{0};
  const auto read = [&](MapReader reader) {
    std::optional<MapSnapshot> kept;
    while (!stop) {
      auto snapshot = reader.latest();
      if (!snapshot) continue;
      const auto expected = static_cast<QuantizedLogOdds>(snapshot->frame_count() % 256);
      snapshot->for_each_known_block([&](const BlockIndex&, const VoxelBlock& block) {
        for (const QuantizedLogOdds voxel : block.voxels) torn += voxel == expected ? 0 : 1;
      });
      ++seen;
      if (seen % 7 == 0) kept = std::move(snapshot);  // some readers are slow to let go
    }
  };
  std::thread a(read, map.reader()), b(read, map.reader()), c(read, map.reader());
  for (std::uint64_t frame = 1; frame <= 3000 || seen < 100; ++frame) {
    for_each_block(map.window(), [&](const BlockIndex& index) {
      map.writable(index).voxels.fill(static_cast<QuantizedLogOdds>(frame % 256));
    });
    map.publish({frame});
  }
  stop = true;
  a.join();
  b.join();
  c.join();
  EXPECT_EQ(torn, 0);
}

}  // namespace
}  // namespace swiftlet
