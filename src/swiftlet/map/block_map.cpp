// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/map/block_map.hpp"

#include <algorithm>
#include <tuple>

namespace swiftlet {
const VoxelBlock* BlockMap::find(const BlockIndex& index) const {
  const auto found = blocks_.find(index);
  return found == blocks_.end() ? nullptr : &found->second;
}

VoxelBlock& BlockMap::writable(const BlockIndex& index) {
  const auto [place, is_new] = blocks_.try_emplace(index);
  if (is_new) {
    place->second.clear();
    extent_ = joined(extent_, {index, {1, 1, 1}});
  }
  return place->second;
}

std::vector<BlockIndex> BlockMap::sorted_blocks() const {
  std::vector<BlockIndex> order;
  order.reserve(blocks_.size());
  for (const auto& [index, block] : blocks_) order.push_back(index);
  std::ranges::sort(order, {}, [](const BlockIndex& b) { return std::tuple(b.z, b.y, b.x); });
  return order;
}

void BlockMap::clear() {
  blocks_.clear();
  extent_ = {};
}

}  // namespace swiftlet
