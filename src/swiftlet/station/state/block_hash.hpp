// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet::station {

/// Tells two maps apart: how many blocks and voxels, and a sum of hashes that does not depend on
/// the order in which the blocks came. Both ends keep it up to date block by block.
struct MapDigest {
  std::uint32_t blocks = 0;
  std::uint32_t occupied = 0;
  std::uint32_t free = 0;
  std::uint32_t hash_a = 0;  ///< sum of block_hash(.., 0) modulo 2^32
  std::uint32_t hash_b = 0;  ///< sum of block_hash(.., 1) modulo 2^32
  friend bool operator==(const MapDigest&, const MapDigest&) = default;
};

/// MurmurHash3_x86_32 (Appleby 2011, public domain) of 524 bytes: x, y, z as little-endian int32,
/// then the 512 voxels. 32-bit words, because JavaScript has no fast 64-bit ones.
[[nodiscard]] constexpr std::uint32_t block_hash(const BlockIndex& index, const VoxelBlock& block,
                                                 std::uint32_t seed) {
  std::uint32_t h = seed;
  const auto add = [&h](std::uint32_t word) {
    word *= 0xcc9e2d51U;
    word = std::rotl(word, 15);
    word *= 0x1b873593U;
    h = std::rotl(h ^ word, 13) * 5 + 0xe6546b64U;
  };
  add(static_cast<std::uint32_t>(index.x));
  add(static_cast<std::uint32_t>(index.y));
  add(static_cast<std::uint32_t>(index.z));
  for (std::size_t i = 0; i < block.voxels.size(); i += 4) {
    add(static_cast<std::uint32_t>(block.voxels[i]) |
        static_cast<std::uint32_t>(block.voxels[i + 1]) << 8U |
        static_cast<std::uint32_t>(block.voxels[i + 2]) << 16U |
        static_cast<std::uint32_t>(block.voxels[i + 3]) << 24U);
  }
  constexpr std::uint32_t kBytes = 3 * 4 + kBlockVoxels;
  h ^= kBytes;
  h = (h ^ (h >> 16U)) * 0x85ebca6bU;
  h = (h ^ (h >> 13U)) * 0xc2b2ae35U;
  return h ^ (h >> 16U);
}

}  // namespace swiftlet::station
