// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// A hash table of a fixed number of blocks. Allocates in its constructor only; the system commits
/// the pages as they are first used.
class BlockBuffer {
 public:
  explicit BlockBuffer(std::size_t capacity)
      : capacity_(capacity),
        blocks_(new VoxelBlock[capacity]),
        table_(std::bit_ceil(2 * capacity + 2), kEmpty) {
    entries_.reserve(capacity);
  }

  [[nodiscard]] std::size_t size() const { return entries_.size(); }
  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] bool full() const { return entries_.size() == capacity_; }

  /// Puts a block in, in place of an older one of the same index; false if there is no room.
  bool put(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) {
    std::uint32_t& slot = table_[probe(index)];
    if (slot == kEmpty) {
      if (full()) return false;
      slot = static_cast<std::uint32_t>(entries_.size());
      entries_.push_back({index, version, true});
    }
    entries_[slot] = {index, version, true};
    blocks_[slot] = block;
    return true;
  }

  /// Null if it is not here.
  [[nodiscard]] const VoxelBlock* find(const BlockIndex& index) const {
    const std::uint32_t slot = table_[probe(index)];
    return slot == kEmpty || !entries_[slot].is_alive ? nullptr : &blocks_[slot];
  }

  void forget(const BlockIndex& index) {
    const std::uint32_t slot = table_[probe(index)];
    if (slot != kEmpty) entries_[slot].is_alive = false;  // keeps its room until clear()
  }

  void clear() {
    if (entries_.empty()) return;
    entries_.clear();
    std::ranges::fill(table_, kEmpty);
  }

  /// Calls visit(BlockIndex, const VoxelBlock&, version) in the order of arrival.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (std::size_t i = 0; i < entries_.size(); ++i) {
      if (entries_[i].is_alive) visit(entries_[i].index, blocks_[i], entries_[i].version);
    }
  }

 private:
  struct Entry {
    BlockIndex index;
    std::uint64_t version;
    bool is_alive;
  };
  static constexpr std::uint32_t kEmpty = 0xffffffffU;

  /// Where the index stands or would stand; the table is never more than half full.
  [[nodiscard]] std::size_t probe(const BlockIndex& index) const {
    const std::size_t mask = table_.size() - 1;
    std::size_t at = BlockHash{}(index)&mask;
    while (table_[at] != kEmpty && entries_[table_[at]].index != index) at = (at + 1) & mask;
    return at;
  }

  std::size_t capacity_;
  std::unique_ptr<VoxelBlock[]> blocks_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> table_;
};

}  // namespace swiftlet
