// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/map/block_window.hpp"
#include "swiftlet/map/occupancy_map.hpp"
#include "swiftlet/map/snapshot_store.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// The map as it stood after one whole frame; never changes while it is held. Answers
/// `map.occupancy(p_world)`, `map.probability(voxel)` (VoxelLookup) and every query of query/.
///
/// Frame: world. Thread safety: any thread, any number of readers. Cost: copying takes a reference;
/// reading a voxel is two array look-ups. A held snapshot keeps its blocks from being reused, so
/// let go of it after planning: while all of them (SnapshotStore::kSlots) are held, the mapper goes
/// on but publishes nothing newer.
class MapSnapshot : public VoxelLookup<MapSnapshot> {
 public:
  /// Edge of a voxel [m]
  [[nodiscard]] double voxel_m() const { return slot().voxel_m; }
  /// The box of blocks that the map covered.
  [[nodiscard]] const BlockWindow& window() const { return slot().window; }
  /// The same: outside of it nothing is known.
  [[nodiscard]] const BlockWindow& extent() const { return slot().window; }
  /// How its voxels are read.
  [[nodiscard]] const LogOddsScale& scale() const { return slot().scale; }
  /// Where belief becomes a claim.
  [[nodiscard]] const OccupancyThresholds& thresholds() const { return slot().scale.thresholds; }
  /// Number of frames integrated so far.
  [[nodiscard]] std::uint64_t frame_count() const { return slot().mark.frame_count; }
  /// Of the newest frame, in its source's clock: how old the map is. Means nothing before the
  /// first.
  [[nodiscard]] Stamp stamp() const { return slot().mark.stamp; }
  /// Where the newest frame was seen from. The identity before the first.
  [[nodiscard]] const Transform<World, Camera>& T_world_camera() const {
    return slot().mark.T_world_camera;
  }

  /// The block, or null where the window holds nothing but unknown voxels. kUnknownVoxel outside
  /// the window, too.
  [[nodiscard]] const VoxelBlock* find(const BlockIndex& index) const;

  /// Tells whether a block has changed since an earlier look: the publication in which this version
  /// was born. 0 where there is no block.
  [[nodiscard]] std::uint64_t version(const BlockIndex& index) const;

  /// Tells whose versions these are: the same owner (std::owner_less) for all snapshots of one map,
  /// and of no other one, even after the map has gone.
  [[nodiscard]] std::weak_ptr<const void> map_identity() const { return store_; }

  /// Calls visit(BlockIndex, const VoxelBlock&) for every block that holds more than unknown
  /// voxels, x fastest.
  template <class Visit>
  void for_each_known_block(Visit&& visit) const {
    for_each_block(window(), [&](const BlockIndex& index) {
      if (const VoxelBlock* block = find(index)) visit(index, *block);
    });
  }

  /// Holds the same state once more. Does not allocate.
  MapSnapshot(const MapSnapshot& other);
  /// Takes it over; `other` can only be assigned to or destroyed.
  MapSnapshot(MapSnapshot&& other) noexcept;
  /// Lets go of what it holds, and holds the other's.
  MapSnapshot& operator=(MapSnapshot other) noexcept;
  ~MapSnapshot();

 private:
  friend class MapReader;
  friend class RollingMap;
  MapSnapshot(std::shared_ptr<SnapshotStore> store, int slot)
      : store_(std::move(store)), slot_(slot) {}
  [[nodiscard]] const SnapshotSlot& slot() const { return store_->slot(slot_); }

  std::shared_ptr<SnapshotStore> store_;  // null only after a move
  int slot_ = 0;
};

/// A reader's end of a map: hands out the newest published snapshot. While at least one MapReader
/// exists, the mapper publishes after every frame; with none, snapshots cost nothing. Thread
/// safety: each MapReader belongs to one thread; make one per thread.
class MapReader {
 public:
  /// The newest snapshot; nullopt before the first frame that ends after this reader was made.
  /// Never blocks the mapper and is never blocked by it.
  [[nodiscard]] std::optional<MapSnapshot> latest() const;

  /// Takes the other's place.
  MapReader(MapReader&&) noexcept = default;
  /// Takes the other's place.
  MapReader& operator=(MapReader&& other) noexcept;
  ~MapReader();

 private:
  friend class RollingMap;
  explicit MapReader(std::shared_ptr<SnapshotStore> store);
  std::shared_ptr<SnapshotStore> store_;
};

}  // namespace swiftlet
