// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

#include "support/seeds.hpp"
#include "support/temp_folder.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/store/map_file/saved_map.hpp"
#include "swiftlet/store/stream/block_store.hpp"

namespace swiftlet::test {

using Blocks = std::map<BlockIndex, VoxelBlock>;

/// What a map file holds; a failed expectation if it is not sound.
inline Blocks blocks_in(const std::filesystem::path& path) {
  Blocks blocks;
  auto map = load_map(path);
  EXPECT_TRUE(map.has_value()) << (map ? "" : map.error().text());
  if (!map) return blocks;
  auto read = map->for_each_block([&](const BlockIndex& index, const VoxelBlock& b) -> Status {
    blocks[index] = b;
    return Done{};
  });
  EXPECT_TRUE(read.has_value()) << (read ? "" : read.error().text());
  return blocks;
}

inline Blocks blocks_in(const MapSnapshot& map) {
  Blocks blocks;
  map.for_each_known_block([&](const BlockIndex& i, const VoxelBlock& b) { blocks[i] = b; });
  return blocks;
}

/// A block whose voxels all differ from unknown now and then; compresses as badly as any.
inline VoxelBlock random_block(Random& random) {
  VoxelBlock block;
  for (QuantizedLogOdds& voxel : block.voxels)
    voxel = static_cast<QuantizedLogOdds>(random.integer(0, 255));
  return block;
}

inline VoxelBlock block_full_of(int value) {
  VoxelBlock block;
  block.voxels.fill(static_cast<QuantizedLogOdds>(value));
  return block;
}

/// A window of about 4 x 4 x 2 blocks of 0.8 m, which moves as soon as the vehicle does.
inline RollingMap small_map() {
  RollingMap::Options options;
  options.voxel_m = 0.1;
  options.size_m = {2.4, 2.4, 0.8};
  options.trigger_m = {0.1, 0.1, 0.1};
  auto map = RollingMap::create(options);
  EXPECT_TRUE(map.has_value());
  return std::move(*map);
}

inline std::vector<char> bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_bytes(const std::filesystem::path& path, const std::vector<char>& bytes) {
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

}  // namespace swiftlet::test
