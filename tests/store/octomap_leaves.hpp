// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>
#include <octomap/OcTree.h>

#include <algorithm>
#include <filesystem>
#include <tuple>
#include <vector>

#include "swiftlet/store/export/octomap_import.hpp"

namespace swiftlet::test {

/// What our own reader makes of a file, next to what liboctomap makes of it.
template <class Tree>
void expect_same_leaves(const std::filesystem::path& path, const Tree& tree) {
  std::vector<std::tuple<VoxelIndex, int, bool>> ours;
  const auto read = read_octomap(path, [&](const OctomapLeaf& leaf) {
    ours.emplace_back(leaf.first, leaf.edge, leaf.is_occupied);
  });
  ASSERT_TRUE(read.has_value()) << read.error().text();
  std::vector<std::tuple<VoxelIndex, int, bool>> theirs;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const octomap::OcTreeKey k = leaf.getIndexKey();
    theirs.emplace_back(VoxelIndex{k[0] - 32768, k[1] - 32768, k[2] - 32768},
                        1 << (16 - leaf.getDepth()), tree.isNodeOccupied(*leaf));
  }
  std::ranges::sort(ours);
  std::ranges::sort(theirs);
  EXPECT_TRUE(ours == theirs) << ours.size() << " leaves, liboctomap has " << theirs.size();
  EXPECT_EQ(read->nodes, tree.size());
  EXPECT_EQ(read->voxel_m, tree.getResolution());
}

}  // namespace swiftlet::test
