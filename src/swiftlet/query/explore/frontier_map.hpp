// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "swiftlet/map/block_directory.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/query/distance/block_bits.hpp"

namespace swiftlet {

/// Where what is known ends: the free voxels with an unknown face neighbour, kept as the map grows.
///
/// Neighbours outside the window do not count: they may have been seen and have left it, so the rim
/// of the window is no frontier; the window's next move tells.
/// Thread safety: one owner, on any thread; it follows the snapshots of one map, some may be left
/// out. Memory: 208 bytes a block of the window. Cost of update(): a look at the version of each
/// block, and words for those that changed and their six neighbours. Allocates only for the first
/// map, or one of another size.
class FrontierMap {
 public:
  /// Empty.
  explicit FrontierMap(const OccupancyThresholds& thresholds = {}) : thresholds_(thresholds) {}

  /// What an update did.
  struct Work {
    std::size_t blocks_changed =
        0;  ///< blocks with a voxel that became free or unknown, or left it
    std::size_t blocks_searched = 0;  ///< that had changed, or lie beside such
  };
  /// Brings the frontier up to a newer snapshot. A map that was begun anew is noticed by another
  /// size or a lower frame count; call clear() if it may have neither.
  Work update(const MapSnapshot& map);
  /// Forgets everything.
  void clear() { *this = FrontierMap(thresholds_); }

  /// Where belief becomes a claim.
  [[nodiscard]] const OccupancyThresholds& thresholds() const { return thresholds_; }
  /// Of the newest snapshot.
  [[nodiscard]] const BlockWindow& window() const { return directory_.window(); }
  /// Edge of a voxel of the newest snapshot [m]
  [[nodiscard]] double voxel_m() const { return voxel_m_; }
  /// Voxels of the frontier.
  [[nodiscard]] std::size_t voxel_count() const { return voxel_count_; }

  /// The frontier's voxels in a block; none outside the window.
  [[nodiscard]] BlockBits voxels_of(const BlockIndex& block) const {
    return is_within(block) ? entries_[directory_.entry_of(block)].frontier : BlockBits{};
  }
  /// Whether nothing is known of a voxel.
  [[nodiscard]] bool is_unknown(const VoxelIndex& v) const {
    const BlockIndex block = block_of(v);
    if (!is_within(block)) return false;
    const auto offset = static_cast<unsigned>(offset_in_block(v));
    const BlockBits& bits = entries_[directory_.entry_of(block)].unknown;
    return (bits[offset / 64U] >> (offset % 64U) & 1U) != 0;
  }

  /// Calls visit(VoxelIndex) for every voxel of the frontier, block by block.
  template <class Visit>
  void for_each_voxel(Visit&& visit) const {
    if (voxel_count_ == 0) return;
    for_each_block(window(), [&](const BlockIndex& block) {
      const Entry& entry = entries_[directory_.entry_of(block)];
      if (entry.voxel_count == 0) return;
      for (int z = 0; z < kBlockEdge; ++z) {
        for (auto left = entry.frontier[static_cast<std::size_t>(z)]; left != 0; left &= left - 1)
          visit(voxel_at(block, 64 * z + std::countr_zero(left)));
      }
    });
  }

 private:
  static constexpr std::uint64_t kNeverSeen = std::numeric_limits<std::uint64_t>::max();

  struct Entry {
    std::uint64_t seen = kNeverSeen;  // MapSnapshot::version() that the bits are of
    BlockBits free{};
    BlockBits unknown{};  // none until it was seen: as outside the window
    BlockBits frontier{};
    std::uint16_t voxel_count = 0;
    bool is_waiting = false;
  };

  [[nodiscard]] bool is_within(const BlockIndex& b) const {
    return !entries_.empty() && window().contains(b);
  }
  [[nodiscard]] const BlockBits& unknown_of(const BlockIndex& b) const;
  void begin(const MapSnapshot& map);
  void move_to(const BlockWindow& to);
  void wait(const BlockIndex& b);
  void wait_around(const BlockIndex& b);
  [[nodiscard]] bool look_at(const BlockIndex& b, const MapSnapshot& map);
  void search(const BlockIndex& b);

  OccupancyThresholds thresholds_;
  double voxel_m_ = 0.0;
  std::uint64_t frame_count_ = 0;
  BlockDirectory directory_;  // only for where entries are
  std::vector<Entry> entries_;
  std::vector<BlockIndex> waiting_;  // to be searched again
  std::size_t voxel_count_ = 0;
};

}  // namespace swiftlet
