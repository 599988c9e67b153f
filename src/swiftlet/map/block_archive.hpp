// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>

#include "swiftlet/map/block_window.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// Where blocks go that leave the window, and where they come from when it returns.
/// Called by the mapping thread, only in a frame that moves the window.
class BlockArchive {
 public:
  virtual ~BlockArchive() = default;

  /// Takes a block that leaves the window. The block is valid during the call only. `version` is
  /// what MapSnapshot::version() tells of this state, so an archive that also follows snapshots
  /// knows which of the two is newer.
  virtual void evict(const BlockIndex& index, const VoxelBlock& block, std::uint64_t version) = 0;

  /// Copies the newest state of a block into `out`, bit for bit as it was evicted; false if it was
  /// never stored.
  [[nodiscard]] virtual bool restore(const BlockIndex& index, VoxelBlock& out) = 0;

  /// A hint, after each shift: blocks around this window may be asked for next.
  virtual void expect_around(const BlockWindow& window) = 0;
};

}  // namespace swiftlet
