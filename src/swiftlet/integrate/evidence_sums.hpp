// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/integrate/step_rounding.hpp"
#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet {

/// One frame's evidence, summed per voxel before it meets the map (method 6).
///
/// A single ray gives far less than one step of a byte, so evidence is gathered first, in fixed
/// point: integers add up to the same sum in any order. Only blocks that rays touched have sums.
/// Sums are steps * 2^20 in 32 bits: a frame gives a voxel at most sqrt(3) whole observations (the
/// projected area of a cube) of at most 127 steps, a ninth of the range, or by
/// PrecisionWeightedModel one of at most 500 steps, a quarter; and one ray at 1 m gives some 190
/// units of the last place.
class EvidenceSums {
 public:
  /// `logodds_per_step`: of add_log_odds().
  explicit EvidenceSums(double logodds_per_step)
      : fixed_per_log_odds_(kOneStep / logodds_per_step) {}

  /// Forgets all sums; `window` is where the next ones may fall. Allocates only while the frames
  /// grow.
  void begin(const BlockWindow& window);

  /// REQUIRES: voxel lies in the window.
  void add(const VoxelIndex& voxel, FixedSteps fixed_steps) {
    sums_of(block_of(voxel)).steps[offset_in_block(voxel)] += fixed_steps;
  }
  void add_log_odds(const VoxelIndex& voxel, double log_odds) {
    add(voxel, static_cast<FixedSteps>(std::lrint(log_odds * fixed_per_log_odds_)));
  }
  /// Adds to what marks a voxel as not free (PrecisionWeightedModel::Evidence::ends), in whole
  /// observations: the sign of the sum counts. REQUIRES: |ends| < 100 in one frame.
  void add_ends(const VoxelIndex& voxel, double ends) {
    constexpr double kEndUnit = 1 << 20;
    sums_of(block_of(voxel)).ends[offset_in_block(voxel)] +=
        static_cast<std::int32_t>(std::lrint(ends * kEndUnit));
  }

  /// Adds every sum to its voxel once (add_evidence()). Returns the number of voxels with evidence.
  std::size_t apply(std::uint64_t frame_number, RollingMap& map);

  [[nodiscard]] std::size_t touched_blocks() const { return touched_.size(); }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  struct BlockSums {
    std::array<FixedSteps, kBlockVoxels> steps{};
    std::array<std::int32_t, kBlockVoxels> ends{};
  };
  static constexpr std::uint32_t kUntouched = 0xffffffffU;

  BlockSums& sums_of(const BlockIndex& block) {
    if (block == last_block_) return sums_[last_slot_];
    return find_or_touch(block);
  }
  BlockSums& find_or_touch(const BlockIndex& block);

  double fixed_per_log_odds_;
  BlockWindow window_{};
  std::vector<std::uint32_t> slot_of_;  // per block of the window: index into touched_ and sums_
  std::vector<BlockIndex> touched_;
  std::vector<BlockSums> sums_;  // all zero between frames
  BlockIndex last_block_{};      // the block of the last add(): rays stay in one for several voxels
  std::uint32_t last_slot_ = 0;
};

}  // namespace swiftlet
