// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <bitset>
#include <unordered_map>

#include "swiftlet/base/voxel_index.hpp"

namespace swiftlet {

/// A set of block indices: one bit a block, in regions of 8 x 8 x 8 blocks. Small and seldom
/// rehashed, so that the mapping thread, which asks it under a lock, never waits long.
class BlockSet {
 public:
  void insert(const BlockIndex& b) { regions_[region_of(b)].set(bit_of(b)); }
  void erase(const BlockIndex& b) {
    const auto region = regions_.find(region_of(b));
    if (region == regions_.end()) return;
    region->second.reset(bit_of(b));
    if (region->second.none()) regions_.erase(region);
  }
  [[nodiscard]] bool contains(const BlockIndex& b) const {
    const auto region = regions_.find(region_of(b));
    return region != regions_.end() && region->second.test(bit_of(b));
  }

 private:
  // A block is to its region what a voxel is to its block.
  [[nodiscard]] static BlockIndex region_of(const BlockIndex& b) {
    return block_of(VoxelIndex{b.x, b.y, b.z});
  }
  [[nodiscard]] static std::size_t bit_of(const BlockIndex& b) {
    return offset_in_block(VoxelIndex{b.x, b.y, b.z});
  }
  std::unordered_map<BlockIndex, std::bitset<kBlockVoxels>, BlockHash> regions_;
};

}  // namespace swiftlet
