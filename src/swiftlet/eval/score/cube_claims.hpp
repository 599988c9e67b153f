// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/map/log_odds.hpp"

namespace swiftlet::eval {

/// What a map claims: its free and occupied voxels, in cubes that no two share a voxel; all others
/// are unknown. A cube's edge is a power of two and its place a multiple of it, counted from the
/// corner of OctoMap's world, so of two cubes that meet one holds the other. Memory and work go
/// with the number of cubes, not of voxels: a few bytes of an OctoMap may claim 2^48 of these.
class CubeClaims {
 public:
  explicit CubeClaims(double voxel_m) : voxel_m_(voxel_m) {}

  [[nodiscard]] double voxel_m() const { return voxel_m_; }
  void set_voxel_m(double voxel_m) { voxel_m_ = voxel_m; }
  /// REQUIRES: edge is a power of two up to 65536, `first` a multiple of it from kCorner, and the
  /// state not unknown.
  void add(const VoxelIndex& first, std::int32_t edge, Occupancy state);

  /// Voxels by what the first map claims (row) and the second (column). Voxels unknown to both are
  /// not counted.
  using Confusion = std::array<std::array<std::uint64_t, 3>, 3>;
  friend Confusion compare_claims(const CubeClaims& a, const CubeClaims& b);

 private:
  static constexpr std::int32_t kCorner = -32768;  // where all cubes have a corner, large and small
  static constexpr std::size_t kLevels = 17;       // edges 1, 2, 4 .. 65536

  [[nodiscard]] static VoxelIndex place_of(const VoxelIndex& voxel, std::size_t level);
  /// The state of the cube that holds all of another one; unknown if there is none. `level`: of the
  /// smallest cube to look for.
  [[nodiscard]] Occupancy around(const VoxelIndex& place, std::size_t place_level,
                                 std::size_t level) const;
  [[nodiscard]] std::array<std::uint64_t, 3> voxels() const;

  double voxel_m_;
  std::array<std::unordered_map<VoxelIndex, Occupancy, VoxelHash>, kLevels> cubes_;
};

[[nodiscard]] CubeClaims::Confusion compare_claims(const CubeClaims& a, const CubeClaims& b);

}  // namespace swiftlet::eval
