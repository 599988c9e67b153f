// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "swiftlet/store/map_file/saved_map.hpp"

namespace swiftlet::test {

/// Every block of a map file, to compare maps bit by bit. A map that cannot be read fails the test.
[[nodiscard]] inline std::map<BlockIndex, VoxelBlock> blocks_of(const std::filesystem::path& path) {
  std::map<BlockIndex, VoxelBlock> blocks;
  const auto map = load_map(path);
  EXPECT_TRUE(map) << map.error().text();
  if (!map) return blocks;
  EXPECT_TRUE(map->for_each_block([&](const BlockIndex& index, const VoxelBlock& block) -> Status {
    blocks.emplace(index, block);
    return Done{};
  }));
  return blocks;
}

}  // namespace swiftlet::test
