// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/store/export/octomap_blocks.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "support/temp_folder.hpp"
#include "swiftlet/query/known_voxels.hpp"

namespace swiftlet {
namespace {

using test::TempFolder;

constexpr OccupancyThresholds kLaidOut;

/// A .bt whose root has one child that is a leaf, below so many inner nodes; child 0 each time.
std::string one_leaf(int depth, bool is_occupied) {
  std::string text = "# Octomap OcTree binary file\nid OcTree\nsize " + std::to_string(depth + 1) +
                     "\nres 0.1\ndata\n";
  for (int i = 1; i < depth; ++i) text += std::string("\x03\0", 2);
  return text + std::string(is_occupied ? "\x02\0" : "\x01\0", 2);
}

TEST(OctomapBlocks, lays_out_leaves_of_every_size_that_fits) {
  const TempFolder folder;
  for (const int depth : {16, 15, 13, 12, 9}) {  // edges 1, 2, 8, 16 and 128
    for (const bool is_occupied : {true, false}) {
      test::write_file(folder / "a.bt", one_leaf(depth, is_occupied));
      const auto out = read_octomap_blocks(folder / "a.bt", kLaidOut);
      ASSERT_TRUE(out) << out.error().text();
      std::uint64_t voxels = 0;
      for_each_known_voxel(out->blocks, [&](const VoxelIndex&, QuantizedLogOdds, Occupancy state) {
        EXPECT_EQ(state == Occupancy::kOccupied, is_occupied);
        ++voxels;
      });
      EXPECT_EQ(voxels, std::uint64_t{1} << (3 * (16 - depth))) << depth;
      EXPECT_NE(out->blocks.find(block_of({-32768, -32768, -32768})), nullptr);
    }
  }
}

TEST(OctomapBlocks, refuses_a_leaf_that_stands_for_more_than_a_memory_holds_in_no_time) {
  const TempFolder folder;
  const auto start = std::chrono::steady_clock::now();
  for (const int depth : {1, 2, 5}) {
    test::write_file(folder / "a.bt", one_leaf(depth, false));
    const auto out = read_octomap_blocks(folder / "a.bt", kLaidOut);
    ASSERT_FALSE(out) << depth;
    EXPECT_EQ(out.error().code, ErrorCode::kUnsupported);
  }
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
}

}  // namespace
}  // namespace swiftlet
