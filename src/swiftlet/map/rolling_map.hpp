// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/block_archive.hpp"
#include "swiftlet/map/block_directory.hpp"
#include "swiftlet/map/frame_mark.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/map/occupancy_map.hpp"
#include "swiftlet/map/snapshot_store.hpp"

namespace swiftlet {

/// Log-odds of a box of space that follows the vehicle (method 7).
///
/// Frame: world. The window is a box of whole 8 x 8 x 8-voxel blocks, at least size_m plus one
/// block along each axis, so that wherever inside a block the vehicle is, the box of size_m
/// around it is covered. It moves by whole blocks: blocks are the unit of storage, of sharing with
/// readers and of eviction, so a move by voxels would split every block on the rim for no gain; the
/// spare block pays for the difference. Thread safety: one writer; any readers through reader().
/// Invariants:
///   1. a block exists only inside window(); recentre() is the only place that moves it
///   2. a voxel that entered the window and was neither observed nor restored is exactly
///   kUnknownVoxel
///   3. a block that readers may see never changes (SnapshotStore)
/// Cost: look-up and update O(1), recentre O(slab that leaves and enters), snapshot O(blocks in the
/// window) in words. Never allocates after construction.
class RollingMap : public VoxelLookup<RollingMap> {
 public:
  /// The vehicle stays within this distance of the origin along each axis, so that indices fit.
  static constexpr double kMaxCoordinate_m = 1e6;

  /// Voxel size and window.
  struct Options {
    double voxel_m = 0.2;  ///< edge of a voxel
    Eigen::Vector3d size_m{20.0, 20.0,
                           6.0};  ///< edges of the box that is covered around the vehicle
    Eigen::Vector3d trigger_m{1.0, 1.0, 1.0};  ///< half extents of the trigger box
  };

  /// What a move of the window did.
  struct Shift {
    bool moved = false;               ///< whether the window moved
    std::size_t blocks_evicted = 0;   ///< that left the window
    std::size_t blocks_restored = 0;  ///< that entered it and were known
  };

  /// `scale`: how its readers are to understand the voxels; the map itself only stores them.
  /// Errors: kInvalidConfig if an option is not positive and finite, or the window has no room for
  /// a voxel or more than 2^24 blocks (8 GiB); kOutOfMemory if the blocks cannot be reserved.
  [[nodiscard]] static Expected<RollingMap> create(const Options& options,
                                                   const LogOddsScale& scale = {});

  /// Edge of a voxel [m]
  [[nodiscard]] double voxel_m() const { return options_.voxel_m; }
  /// How its voxels are read.
  [[nodiscard]] const LogOddsScale& scale() const { return scale_; }
  /// The box of blocks that the map covers now.
  [[nodiscard]] const BlockWindow& window() const { return directory_.window(); }
  /// The same: outside of it nothing is known.
  [[nodiscard]] const BlockWindow& extent() const { return window(); }

  /// Keeps the vehicle, or a place ahead of it, in the middle: when it has left the trigger box
  /// around the place of the last move (or on the first call), moves the window so that it is
  /// within half a block of the middle again. What leaves goes to `archive`, what enters comes from
  /// it; null drops and forgets. REQUIRES: p_world finite and within +-10^6 m.
  Shift recentre(const Eigen::Vector3d& p_world, BlockArchive* archive);

  /// Forgets every voxel, as if nothing had ever been mapped; the next recentre() is a first one.
  /// Snapshots that readers hold keep what they show. Cost: O(blocks of the window).
  void clear();

  /// The block, or null if the window holds nothing but unknown voxels there (or it lies outside).
  [[nodiscard]] const VoxelBlock* find(const BlockIndex& index) const;

  /// The block for writing, made of unknown voxels if there was none. The reference is good until
  /// the next publish(). REQUIRES: window().contains(index).
  [[nodiscard]] VoxelBlock& writable(const BlockIndex& index);

  /// Calls visit(BlockIndex, const VoxelBlock&) for every block that exists, x fastest.
  template <class Visit>
  void for_each_known_block(Visit&& visit) const {
    for_each_block(window(), [&](const BlockIndex& index) {
      if (const VoxelBlock* block = find(index)) visit(index, *block);
    });
  }

  /// A reader for another thread.
  [[nodiscard]] MapReader reader() const { return MapReader(store_); }
  /// Hands the present state to the readers, if there are any; false if they hold every slot.
  /// `mark`: the newest frame in it.
  bool publish(const FrameMark& mark);
  /// The present state, for the writer's own use; nullopt if readers hold every slot.
  [[nodiscard]] std::optional<MapSnapshot> snapshot(const FrameMark& mark);

  /// Memory that the map occupies by now: blocks ever used, directories, book-keeping [bytes].
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  RollingMap(const Options& options, const LogOddsScale& scale, BlockPool pool,
             const BlockIndex& window_size);
  [[nodiscard]] BlockIndex first_block_around(const Eigen::Vector3d& p_world) const;

  Options options_;
  LogOddsScale scale_;
  std::shared_ptr<SnapshotStore> store_;
  BlockDirectory directory_;
  std::optional<Eigen::Vector3d> anchor_;  // where the vehicle was at the last move [m, world]
};

}  // namespace swiftlet
