// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/block_directory.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// A fixed number of blocks, taken and given back in O(1). Reserves its address space once; the
/// system commits a page only when a block on it is first taken, and the block given back last is
/// taken first, so memory follows the space that was seen and not the size of the window.
class BlockPool {
 public:
  /// Errors: kOutOfMemory.
  [[nodiscard]] static Expected<BlockPool> create(std::size_t capacity);

  /// A block with unspecified voxels, marked as born in `epoch`; kNoBlock if all are taken.
  [[nodiscard]] BlockId take(std::uint64_t epoch);
  void give_back(BlockId id) { free_.push_back(id); }

  [[nodiscard]] VoxelBlock& block(BlockId id) { return blocks_[id]; }
  [[nodiscard]] const VoxelBlock& block(BlockId id) const { return blocks_[id]; }
  [[nodiscard]] std::uint64_t born(BlockId id) const { return born_[id]; }

  [[nodiscard]] std::size_t capacity() const { return capacity_; }
  [[nodiscard]] std::size_t taken() const { return ever_taken_ - free_.size(); }
  /// Memory that was ever touched [bytes].
  [[nodiscard]] std::size_t memory_bytes() const {
    return ever_taken_ * (sizeof(VoxelBlock) + sizeof(std::uint64_t)) +
           free_.capacity() * sizeof(BlockId);
  }

 private:
  BlockPool() = default;

  std::size_t capacity_ = 0;
  std::unique_ptr<VoxelBlock[]> blocks_;
  std::unique_ptr<std::uint64_t[]> born_;  // publication epoch in which each block was taken
  std::size_t ever_taken_ = 0;             // blocks [0, ever_taken_) have been in use at some time
  std::vector<BlockId> free_;              // of those, the ones given back
};

}  // namespace swiftlet
