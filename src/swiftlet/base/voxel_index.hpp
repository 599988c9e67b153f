// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>

namespace swiftlet {

/// A voxel of the world grid. Voxel i covers [i, i + 1) * voxel_m along each axis; its centre is (i
/// + 0.5) * voxel_m. The index never changes: it names the same piece of space before and after the
/// window moves.
struct VoxelIndex {
  std::int32_t x = 0;  ///< forward [voxels]
  std::int32_t y = 0;  ///< left [voxels]
  std::int32_t z = 0;  ///< up [voxels]
  friend constexpr auto operator<=>(const VoxelIndex&, const VoxelIndex&) = default;
};

/// Voxels per block edge.
inline constexpr int kBlockEdge = 8;
/// Its logarithm to base 2.
inline constexpr int kBlockShift = 3;
/// Voxels per block.
inline constexpr int kBlockVoxels = kBlockEdge * kBlockEdge * kBlockEdge;

/// A block of 8 x 8 x 8 voxels. Block b holds the voxels [8 b, 8 b + 8) along each axis.
struct BlockIndex {
  std::int32_t x = 0;  ///< forward [blocks]
  std::int32_t y = 0;  ///< left [blocks]
  std::int32_t z = 0;  ///< up [blocks]
  friend constexpr auto operator<=>(const BlockIndex&, const BlockIndex&) = default;
};

/// The voxel that contains a point [m, world]. `floor`, never a cast: a cast folds -0.5 and 0.5
/// together.
[[nodiscard]] inline VoxelIndex voxel_containing(const Eigen::Vector3d& p_world, double voxel_m) {
  const auto index = [voxel_m](double v) {
    return static_cast<std::int32_t>(std::floor(v / voxel_m));
  };
  return {index(p_world.x()), index(p_world.y()), index(p_world.z())};
}

/// Centre of a voxel [m, world].
[[nodiscard]] inline Eigen::Vector3d centre_of(const VoxelIndex& v, double voxel_m) {
  return Eigen::Vector3d(v.x + 0.5, v.y + 0.5, v.z + 0.5) * voxel_m;
}

/// Arithmetic shift is floor division in C++20, so negative voxels land in the right block.
[[nodiscard]] constexpr BlockIndex block_of(const VoxelIndex& v) {
  return {v.x >> kBlockShift, v.y >> kBlockShift, v.z >> kBlockShift};
}

/// Position of a voxel inside its block: x fastest, then y, then z. 0 <= offset < 512.
[[nodiscard]] constexpr std::uint16_t offset_in_block(const VoxelIndex& v) {
  constexpr int kMask = kBlockEdge - 1;
  return static_cast<std::uint16_t>(((v.z & kMask) << (2 * kBlockShift)) |
                                    ((v.y & kMask) << kBlockShift) | (v.x & kMask));
}

/// The voxel of a block with the least index along each axis.
[[nodiscard]] constexpr VoxelIndex first_voxel(const BlockIndex& b) {
  return {b.x * kBlockEdge, b.y * kBlockEdge, b.z * kBlockEdge};
}

/// The voxel at an offset of a block; inverse of block_of() and offset_in_block().
[[nodiscard]] constexpr VoxelIndex voxel_at(const BlockIndex& b, int offset) {
  constexpr int kMask = kBlockEdge - 1;
  return {b.x * kBlockEdge + (offset & kMask), b.y * kBlockEdge + ((offset >> kBlockShift) & kMask),
          b.z * kBlockEdge + (offset >> (2 * kBlockShift))};
}

/// One 64-bit word a voxel or block, well mixed (finaliser of SplitMix64, Steele et al. 2014).
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t v) {
  v += 0x9e3779b97f4a7c15U;
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9U;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebU;
  return v ^ (v >> 31);
}

/// For hash tables whose keys are places.
template <class Index>
struct IndexHash {
  /// Well mixed, and the same on every machine.
  [[nodiscard]] constexpr std::size_t operator()(const Index& i) const {
    const auto word = [](std::int32_t v) {
      return static_cast<std::uint64_t>(static_cast<std::uint32_t>(v));
    };
    return mix_bits(mix_bits(word(i.x) | (word(i.y) << 32)) ^ word(i.z));
  }
};
/// For hash tables of voxels.
using VoxelHash = IndexHash<VoxelIndex>;
/// For hash tables of blocks.
using BlockHash = IndexHash<BlockIndex>;

}  // namespace swiftlet
