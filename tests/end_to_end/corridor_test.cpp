// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// Sixty metres along a corridor and back, with the window of the issue of memory: 20 x 20 x 6 m in
// 5 cm voxels.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <unordered_map>

#include "support/temp_folder.hpp"
#include "swiftlet/pipeline/mapper.hpp"
#include "swiftlet/source/sources.hpp"
#include "swiftlet/store/stream/block_store.hpp"

namespace swiftlet {
namespace {

constexpr std::size_t kWindowLimit_bytes = 40U << 20U;

/// A real store, watched: what comes back must be what went in last.
class WatchedStore final : public BlockArchive {
 public:
  explicit WatchedStore(BlockStore& store) : store_(store) {}

  void evict(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) override {
    evicted[index] = block;
    store_.evict(index, block, version);
  }
  bool restore(const BlockIndex& index, VoxelBlock& out) override {
    const auto last = evicted.find(index);
    const bool is_restored = store_.restore(index, out);
    EXPECT_EQ(is_restored, last != evicted.end());
    if (!is_restored || last == evicted.end()) return is_restored;
    EXPECT_EQ(out, last->second);
    ++restored;
    return true;
  }
  void expect_around(const BlockWindow& window) override { store_.expect_around(window); }

  std::unordered_map<BlockIndex, VoxelBlock, BlockHash> evicted;
  std::size_t restored = 0;

 private:
  BlockStore& store_;
};

/// The built-in scene at 2 Hz: each frame still overlaps the next by half, and the test takes
/// seconds.
std::string slow_corridor(const test::TempFolder& folder) {
  std::ifstream scene(SWIFTLET_SCENES "/corridor_loop.yaml");
  std::stringstream text;
  text << scene.rdbuf();
  std::string yaml = text.str();
  const std::string camera = "camera: { max_range_m: 20 }";
  const std::size_t at = yaml.find(camera);
  EXPECT_NE(at, std::string::npos);
  yaml.replace(at, camera.size(), "camera: { max_range_m: 20, rate_hz: 2 }");
  const auto path = folder.path() / "corridor.yaml";
  std::ofstream(path) << yaml;
  return "sim:" + path.string();
}

TEST(CorridorLoop, keeps_the_window_within_40_MiB_and_gives_back_every_block_bit_for_bit) {
  const test::TempFolder folder;
  MapperConfig config;
  config.map.voxel_m = 0.05;
  auto store = BlockStore::create(folder.path() / "corridor.swl", config.map.voxel_m);
  ASSERT_TRUE(store) << store.error().text();
  WatchedStore archive(**store);
  auto mapper = Mapper::create(config, &archive);
  auto source = open_source(slow_corridor(folder));
  ASSERT_TRUE(mapper && source);

  double farthest_m = 0.0;
  for (;;) {
    const auto frame = (*source)->next();
    ASSERT_TRUE(frame) << frame.error().text();
    if (!*frame) break;
    mapper->integrate(**frame);
    farthest_m = std::max(farthest_m, (*frame)->T_world_camera.translation().x());
    ASSERT_LE(mapper->memory_bytes(), kWindowLimit_bytes);
  }
  EXPECT_GT(farthest_m, 55.0);
  EXPECT_GT(archive.restored, 1000U);
  EXPECT_EQ((*store)->stats().restore_failed, 0U);
  EXPECT_EQ((*store)->stats().lost, 0U);
  RecordProperty("window_bytes", std::to_string(mapper->memory_bytes()));
  RecordProperty("blocks_restored", std::to_string(archive.restored));
}

}  // namespace
}  // namespace swiftlet
