// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "swiftlet/map/block_map.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/station/state/block_hash.hpp"

namespace swiftlet::station {

/// The station's own copy of the map, which its clients are brought into line with: inside the
/// window what the newest snapshot shows, outside of it what each block was when it left.
///
/// Thread safety: the station's thread alone. Memory: about 650 bytes a block, at most
/// `max_blocks`; beyond that the blocks farthest from the window are forgotten.
class MapMirror : public VoxelLookup<MapMirror> {
 public:
  explicit MapMirror(const MapHeader& header = {}, std::size_t max_blocks = 200'000)
      : max_blocks_(max_blocks), map_(header) {}

  /// Takes over what has changed since the last snapshot. Cost: O(blocks in the window) in words.
  void update(const MapSnapshot& snapshot);
  /// A block that has left the window, or one of a saved map. `version` as MapSnapshot::version().
  void put(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version);
  /// Begins a new map: versions start again.
  void clear();

  /// Null where nothing is known.
  [[nodiscard]] const VoxelBlock* find(const BlockIndex& index) const { return map_.find(index); }
  /// Calls visit(BlockIndex, const VoxelBlock&) for every block, in no order.
  template <class Visit>
  void for_each_known_block(Visit&& visit) const {
    map_.for_each_known_block(visit);
  }
  [[nodiscard]] double voxel_m() const { return map_.voxel_m(); }
  [[nodiscard]] const LogOddsScale& scale() const { return map_.scale(); }
  [[nodiscard]] const BlockWindow& extent() const { return map_.extent(); }
  /// A copy of the whole map, with the frames of the newest snapshot in its header.
  [[nodiscard]] BlockMap copy() const;

  /// Blocks that have changed or gone since the last call, each once.
  [[nodiscard]] std::vector<BlockIndex> take_changes();

  [[nodiscard]] const MapDigest& digest() const { return digest_; }
  [[nodiscard]] const BlockWindow& window() const { return window_; }
  [[nodiscard]] std::uint64_t frame_count() const { return frame_count_; }

 private:
  /// What else is known of a block.
  struct Entry {
    std::uint64_t version = 0;
    MapDigest share;  // of the whole map's digest
    bool is_changed = false;
  };
  [[nodiscard]] MapDigest share_of(const BlockIndex& index, const VoxelBlock& block) const;
  void remove(const BlockIndex& index);
  void forget_far_blocks();

  std::size_t max_blocks_;
  BlockMap map_;
  std::unordered_map<BlockIndex, Entry, BlockHash> entries_;  // one a block of map_
  std::vector<BlockIndex> changes_;
  MapDigest digest_;
  BlockWindow window_{};
  std::uint64_t frame_count_ = 0;
};

}  // namespace swiftlet::station
