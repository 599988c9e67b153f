// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "swiftlet/map/log_odds.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// One bit a voxel of a block: a word a layer (z), bit 8 y + x of it. The order of VoxelBlock.
using BlockBits = std::array<std::uint64_t, kBlockEdge>;

namespace block_bits {

inline constexpr std::uint64_t kBytes = 0x0101010101010101U;

/// Eight voxels at once: bit i tells whether byte i of `voxels` is `least` or more.
/// REQUIRES: 0 < least < 256.
[[nodiscard]] constexpr std::uint64_t at_least(std::uint64_t voxels, int least) {
  const std::uint64_t low = voxels & (kBytes * 0x7fU);
  // Adding what the lower seven bits lack carries into the eighth where they are large enough.
  const std::uint64_t is_large =
      least <= 128 ? (low + kBytes * static_cast<std::uint64_t>(128 - least)) | voxels
                   : (low + kBytes * static_cast<std::uint64_t>(256 - least)) & voxels;
  // The eighth bits, gathered in the highest byte by one multiplication.
  return (((is_large >> 7U) & kBytes) * 0x0102040810204080U) >> 56U;
}

}  // namespace block_bits

/// The voxels of one layer that are `least` or more.
[[nodiscard]] inline std::uint64_t voxels_at_least(const VoxelBlock& block, int layer, int least) {
  static_assert(std::endian::native == std::endian::little, "voxel x is byte x of a word");
  if (least <= kFreeVoxel) return ~std::uint64_t{0};
  if (least > kOccupiedVoxel) return 0;
  std::uint64_t bits = 0;
  const QuantizedLogOdds* row =
      block.voxels.data() + std::ptrdiff_t{layer} * kBlockEdge * kBlockEdge;
  for (int y = 0; y < kBlockEdge; ++y, row += kBlockEdge) {
    std::uint64_t voxels = 0;
    std::memcpy(&voxels, row, sizeof voxels);
    bits |= block_bits::at_least(voxels, least) << static_cast<unsigned>(kBlockEdge * y);
  }
  return bits;
}

/// Whether any voxel is `least` or more: one pass of vectors, much quicker than its bits.
[[nodiscard]] inline bool has_voxel_at_least(const VoxelBlock& block, int least) {
  QuantizedLogOdds largest = 0;
  for (const QuantizedLogOdds voxel : block.voxels) largest = std::max(largest, voxel);
  return largest >= least;
}

/// The voxels of one layer with first <= x <= last and likewise y; 0 to 7.
[[nodiscard]] constexpr std::uint64_t voxels_within(int first_x, int last_x, int first_y,
                                                    int last_y) {
  const std::uint64_t row = (0xffU >> static_cast<unsigned>(7 - last_x)) &
                            (0xffU << static_cast<unsigned>(first_x)) & 0xffU;
  const std::uint64_t rows = (~std::uint64_t{0} >> static_cast<unsigned>(8 * (7 - last_y))) &
                             (~std::uint64_t{0} << static_cast<unsigned>(8 * first_y));
  return row * block_bits::kBytes & rows;
}

}  // namespace swiftlet
