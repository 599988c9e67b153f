// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <unordered_map>
#include <vector>

#include "swiftlet/map/map_header.hpp"
#include "swiftlet/map/occupancy_map.hpp"

namespace swiftlet {

/// A whole map in memory: its blocks wherever they lie, with no window. What a file is loaded into,
/// what a flight's evicted blocks are kept in, what is drawn and compared.
///
/// Frame: world. Thread safety: one writer, or any readers. Memory: about 550 bytes a block.
class BlockMap : public VoxelLookup<BlockMap> {
 public:
  BlockMap() = default;
  /// No blocks yet.
  explicit BlockMap(const MapHeader& header) : header_(header) {}

  /// What the map says of itself.
  [[nodiscard]] const MapHeader& header() const { return header_; }
  /// Edge of a voxel [m]
  [[nodiscard]] double voxel_m() const { return header_.voxel_m; }
  /// How its voxels are read.
  [[nodiscard]] const LogOddsScale& scale() const { return header_.scale; }
  /// Blocks that it holds.
  [[nodiscard]] std::size_t block_count() const { return blocks_.size(); }
  /// Holds all blocks; larger than need be after erase(). Of size 0 if there never was one. Extents
  /// that do not fit an int32 are cut at its end.
  [[nodiscard]] const BlockWindow& extent() const { return extent_; }

  /// The block, or null where nothing is known. Valid until the block is erased.
  [[nodiscard]] const VoxelBlock* find(const BlockIndex& index) const;
  /// Calls visit(BlockIndex, const VoxelBlock&) for every block, in no order.
  template <class Visit>
  void for_each_known_block(Visit&& visit) const {
    for (const auto& [index, block] : blocks_) visit(index, block);
  }
  /// Of all blocks, by z, then y, then x: the order of map files.
  [[nodiscard]] std::vector<BlockIndex> sorted_blocks() const;

  /// Changes what the map says of itself; the blocks stay.
  void set_header(const MapHeader& header) { header_ = header; }
  /// The block for writing, made of unknown voxels if there was none.
  [[nodiscard]] VoxelBlock& writable(const BlockIndex& index);
  /// Sets a whole block.
  void put(const BlockIndex& index, const VoxelBlock& block) { writable(index) = block; }
  /// Sets one voxel.
  void set(const VoxelIndex& voxel, QuantizedLogOdds value) {
    writable(block_of(voxel)).voxels[offset_in_block(voxel)] = value;
  }
  /// False if there was no such block.
  bool erase(const BlockIndex& index) { return blocks_.erase(index) > 0; }
  /// Forgets all blocks; the header stays.
  void clear();

 private:
  MapHeader header_;
  std::unordered_map<BlockIndex, VoxelBlock, BlockHash> blocks_;
  BlockWindow extent_{};
};

/// A map of whatever kind, copied into memory. Cost: O(blocks).
template <OccupancyMap Map>
[[nodiscard]] BlockMap copy_blocks(const Map& map, MapHeader header = {}) {
  header.voxel_m = map.voxel_m();
  header.scale = map.scale();
  BlockMap copy(header);
  map.for_each_known_block(
      [&](const BlockIndex& index, const VoxelBlock& block) { copy.put(index, block); });
  return copy;
}

}  // namespace swiftlet
