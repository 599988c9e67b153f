// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/map/block_pool.hpp"

#include <new>

namespace swiftlet {

Expected<BlockPool> BlockPool::create(std::size_t capacity) {
  BlockPool pool;
  pool.capacity_ = capacity;
  // Default-initialised on purpose: writing the voxels here would commit every page.
  pool.blocks_.reset(new (std::nothrow) VoxelBlock[capacity]);
  pool.born_.reset(new (std::nothrow) std::uint64_t[capacity]);
  if (!pool.blocks_ || !pool.born_) {
    return fail(ErrorCode::kOutOfMemory, "map",
                "cannot reserve " + std::to_string(capacity * sizeof(VoxelBlock) >> 20U) +
                    " MiB for the window",
                "make the window smaller or the voxels larger");
  }
  pool.free_.reserve(capacity);
  return pool;
}

BlockId BlockPool::take(std::uint64_t epoch) {
  BlockId id = kNoBlock;
  if (!free_.empty()) {
    id = free_.back();
    free_.pop_back();
  } else if (ever_taken_ < capacity_) {
    id = static_cast<BlockId>(ever_taken_++);
  } else {
    return kNoBlock;
  }
  born_[id] = epoch;
  return id;
}

}  // namespace swiftlet
