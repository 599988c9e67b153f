// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <unordered_map>

#include "swiftlet/map/block_archive.hpp"

namespace swiftlet::eval {

/// Keeps in memory what leaves the window, so that a whole flight can be judged.
class MemoryArchive final : public BlockArchive {
 public:
  void evict(const BlockIndex& index, const VoxelBlock& block, std::uint64_t) override {
    blocks_[index] = block;
  }
  [[nodiscard]] bool restore(const BlockIndex& index, VoxelBlock& out) override {
    const auto found = blocks_.find(index);
    if (found == blocks_.end()) return false;
    out = found->second;
    return true;
  }
  void expect_around(const BlockWindow&) override {}

  [[nodiscard]] const VoxelBlock* find(const BlockIndex& index) const {
    const auto found = blocks_.find(index);
    return found == blocks_.end() ? nullptr : &found->second;
  }

 private:
  std::unordered_map<BlockIndex, VoxelBlock, BlockHash> blocks_;
};

}  // namespace swiftlet::eval
