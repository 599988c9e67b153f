// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/score/cube_claims.hpp"

#include <bit>

#include "swiftlet/base/contract.hpp"

namespace swiftlet::eval {
namespace {

constexpr std::uint64_t voxels_at(std::size_t level) { return std::uint64_t{1} << (3 * level); }

constexpr std::size_t index_of(Occupancy state) { return static_cast<std::size_t>(state); }

}  // namespace

VoxelIndex CubeClaims::place_of(const VoxelIndex& voxel, std::size_t level) {
  // In 64 bits: the corner may lie beyond the world of int32.
  const auto along = [level](std::int32_t v) {
    return static_cast<std::int32_t>((std::int64_t{v} - kCorner) >> level);
  };
  return {along(voxel.x), along(voxel.y), along(voxel.z)};
}

void CubeClaims::add(const VoxelIndex& first, std::int32_t edge, Occupancy state) {
  const auto width = static_cast<std::uint32_t>(edge);
  SWIFTLET_REQUIRE(std::has_single_bit(width) && width <= 65536, "edges are powers of two");
  const auto level = static_cast<std::size_t>(std::countr_zero(width));
  cubes_[level][place_of(first, level)] = state;
}

Occupancy CubeClaims::around(const VoxelIndex& place, std::size_t place_level,
                             std::size_t level) const {
  for (; level < kLevels; ++level) {
    if (cubes_[level].empty()) continue;
    const auto up = [&](std::int32_t v) { return v >> (level - place_level); };
    const auto found = cubes_[level].find({up(place.x), up(place.y), up(place.z)});
    if (found != cubes_[level].end()) return found->second;
  }
  return Occupancy::kUnknown;
}

std::array<std::uint64_t, 3> CubeClaims::voxels() const {
  std::array<std::uint64_t, 3> sums{};
  for (std::size_t level = 0; level < kLevels; ++level) {
    for (const auto& [place, state] : cubes_[level]) sums[index_of(state)] += voxels_at(level);
  }
  return sums;
}

CubeClaims::Confusion compare_claims(const CubeClaims& a, const CubeClaims& b) {
  CubeClaims::Confusion counts{};
  auto only_a = a.voxels(), only_b = b.voxels();
  const auto meet = [&](Occupancy in_a, Occupancy in_b, std::size_t level) {
    if (in_a == Occupancy::kUnknown || in_b == Occupancy::kUnknown) return;
    counts[index_of(in_a)][index_of(in_b)] += voxels_at(level);
    only_a[index_of(in_a)] -= voxels_at(level);
    only_b[index_of(in_b)] -= voxels_at(level);
  };
  // Of two cubes that meet, the smaller one finds the larger; of two equal ones, that of a.
  for (std::size_t level = 0; level < CubeClaims::kLevels; ++level) {
    for (const auto& [place, state] : a.cubes_[level])
      meet(state, b.around(place, level, level), level);
    for (const auto& [place, state] : b.cubes_[level])
      meet(a.around(place, level, level + 1), state, level);
  }
  for (const Occupancy state : {Occupancy::kFree, Occupancy::kOccupied}) {
    counts[index_of(state)][index_of(Occupancy::kUnknown)] = only_a[index_of(state)];
    counts[index_of(Occupancy::kUnknown)][index_of(state)] = only_b[index_of(state)];
  }
  return counts;
}

}  // namespace swiftlet::eval
