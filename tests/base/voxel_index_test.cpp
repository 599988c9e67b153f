// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/base/voxel_index.hpp"

#include <gtest/gtest.h>

#include <set>
#include <unordered_set>

#include "support/seeds.hpp"

namespace swiftlet {
namespace {

using test::Rng;

VoxelIndex any_voxel(Rng& rng, std::int32_t reach) {
  const auto x = test::uniform_integer<std::int32_t>(rng, -reach, reach);
  const auto y = test::uniform_integer<std::int32_t>(rng, -reach, reach);
  return {x, y, test::uniform_integer<std::int32_t>(rng, -reach, reach)};
}

TEST(VoxelIndex, of_its_own_centre_is_itself) {
  for (const double voxel_m : {0.01, 0.03, 0.05, 0.1, 0.2, 0.3, 1.0}) {
    test::for_each_seed(2000, [voxel_m](Rng& rng) {
      const VoxelIndex v = any_voxel(rng, 1'000'000);
      EXPECT_EQ(voxel_containing(centre_of(v, voxel_m), voxel_m), v) << voxel_m;
    });
  }
}

TEST(VoxelIndex, of_a_point_covers_that_point) {
  test::for_each_seed(2000, [](Rng& rng) {
    const double voxel_m = test::uniform(rng, 0.01, 0.5);
    const Eigen::Vector3d p = test::uniform_vector(rng, 50.0);
    const Eigen::Vector3d off = p - centre_of(voxel_containing(p, voxel_m), voxel_m);
    EXPECT_LE(off.cwiseAbs().maxCoeff(), 0.5 * voxel_m * (1.0 + 1e-9));
  });
}

TEST(VoxelIndex, floors_negative_coordinates) {
  EXPECT_EQ(voxel_containing({-0.05, -0.1, -0.15}, 0.1), (VoxelIndex{-1, -1, -2}));
  EXPECT_EQ(voxel_containing({0.05, 0.0, -0.0}, 0.1), (VoxelIndex{0, 0, 0}));
  EXPECT_EQ(voxel_containing({-1e-9, 1e-9, 0}, 0.1), (VoxelIndex{-1, 0, 0}));
}

TEST(BlockIndex, and_offset_name_the_voxel_again) {
  test::for_each_seed(5000, [](Rng& rng) {
    const VoxelIndex v = any_voxel(rng, 2'000'000'000);
    EXPECT_LT(offset_in_block(v), kBlockVoxels);
    EXPECT_EQ(voxel_at(block_of(v), offset_in_block(v)), v);
  });
}

TEST(BlockIndex, holds_512_different_voxels_that_all_name_it) {
  for (const BlockIndex b : {BlockIndex{0, 0, 0}, BlockIndex{-1, 2, -3}}) {
    std::set<VoxelIndex> seen;
    for (int offset = 0; offset < kBlockVoxels; ++offset) {
      const VoxelIndex v = voxel_at(b, offset);
      seen.insert(v);
      EXPECT_EQ(block_of(v), b);
      EXPECT_EQ(offset_in_block(v), offset);
    }
    EXPECT_EQ(seen.size(), static_cast<std::size_t>(kBlockVoxels));
    EXPECT_EQ(*seen.begin(), first_voxel(b));
  }
}

TEST(BlockIndex, of_negative_voxels_is_the_floor) {
  EXPECT_EQ(block_of({-1, -8, -9}), (BlockIndex{-1, -1, -2}));
  EXPECT_EQ(block_of({0, 7, 8}), (BlockIndex{0, 0, 1}));
}

TEST(VoxelHash, tells_the_voxels_of_a_neighbourhood_apart) {
  std::unordered_set<std::size_t> hashes;
  constexpr int kReach = 16;
  for (int x = -kReach; x < kReach; ++x)
    for (int y = -kReach; y < kReach; ++y)
      for (int z = -kReach; z < kReach; ++z) hashes.insert(VoxelHash{}(VoxelIndex{x, y, z}));
  // 32768 words of 64 bits: the chance of any collision is 3e-11.
  EXPECT_EQ(hashes.size(), 32768U);
}

}  // namespace
}  // namespace swiftlet
