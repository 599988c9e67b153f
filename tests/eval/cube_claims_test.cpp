// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/score/cube_claims.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/seeds.hpp"

namespace swiftlet::eval {
namespace {

/// The same claims voxel by voxel, as the model.
struct Model {
  CubeClaims cubes{0.1};
  std::map<VoxelIndex, Occupancy> voxels;

  /// Adds a cube unless a voxel of it is taken.
  void add(const VoxelIndex& first, std::int32_t edge, Occupancy state) {
    const auto each = [&](auto&& visit) {
      for (std::int32_t i = 0; i < edge * edge * edge; ++i)
        visit({first.x + i % edge, first.y + i / edge % edge, first.z + i / edge / edge});
    };
    bool is_taken = false;
    each([&](const VoxelIndex& v) { is_taken = is_taken || voxels.contains(v); });
    if (is_taken) return;
    each([&](const VoxelIndex& v) { voxels[v] = state; });
    cubes.add(first, edge, state);
  }
};

Model random_claims(test::Random& random) {
  Model model;
  for (int i = 0; i < 30; ++i) {
    const std::int32_t edge = 1 << random.integer(0, 3);
    const auto along = [&] { return random.integer(-16 / edge, 16 / edge - 1) * edge; };
    const VoxelIndex first{along(), along(), along()};
    model.add(first, edge, random.integer(0, 1) == 0 ? Occupancy::kFree : Occupancy::kOccupied);
  }
  return model;
}

TEST(CubeClaims, compares_cubes_as_if_voxel_by_voxel) {
  test::for_each_seed(100, [](test::Random& random) {
    const Model a = random_claims(random), b = random_claims(random);
    CubeClaims::Confusion expected{};
    const auto at = [](const Model& model, const VoxelIndex& v) {
      const auto found = model.voxels.find(v);
      return static_cast<std::size_t>(found == model.voxels.end() ? Occupancy::kUnknown
                                                                  : found->second);
    };
    for (const auto& [v, state] : a.voxels) ++expected[at(a, v)][at(b, v)];
    for (const auto& [v, state] : b.voxels) {
      if (!a.voxels.contains(v)) ++expected[at(a, v)][at(b, v)];
    }
    EXPECT_EQ(compare_claims(a.cubes, b.cubes), expected);
  });
}

TEST(CubeClaims, compares_cubes_of_octomaps_whole_world_at_once) {
  CubeClaims world(0.1), voxel(0.1);
  world.add({-32768, -32768, -32768}, 65536, Occupancy::kFree);
  voxel.add({32767, 0, -32768}, 1, Occupancy::kOccupied);
  voxel.add({2'000'000'000, -2'000'000'000, 0}, 1, Occupancy::kFree);  // beyond that world
  const auto counts = compare_claims(world, voxel);
  EXPECT_EQ(counts[0][2], 1U);
  EXPECT_EQ(counts[0][1], (std::uint64_t{1} << 48U) - 1);
  EXPECT_EQ(counts[1][0], 1U);
}

}  // namespace
}  // namespace swiftlet::eval
