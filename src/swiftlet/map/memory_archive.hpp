// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/map/block_archive.hpp"
#include "swiftlet/map/block_map.hpp"

namespace swiftlet {

/// Keeps in memory what leaves the window and gives it back: for flights that are short, or judged.
/// Never forgets, so its memory follows the space that was seen.
class MemoryArchive final : public BlockArchive {
 public:
  MemoryArchive() = default;
  /// `header`: of blocks().
  explicit MemoryArchive(const MapHeader& header) : blocks_(header) {}

  void evict(const BlockIndex& index, const VoxelBlock& block, std::uint64_t) override {
    blocks_.put(index, block);
  }
  [[nodiscard]] bool restore(const BlockIndex& index, VoxelBlock& out) override {
    const VoxelBlock* block = blocks_.find(index);
    if (block == nullptr) return false;
    out = *block;
    return true;
  }
  void expect_around(const BlockWindow&) override {}

  /// What has left the window, as it was when it left; older than the window where that is again.
  [[nodiscard]] const BlockMap& blocks() const { return blocks_; }

 private:
  BlockMap blocks_;
};

}  // namespace swiftlet
