// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/base/worker_team.hpp"
#include "swiftlet/condition/neighbour_kernels.hpp"
#include "swiftlet/integrate/depth_pyramid.hpp"
#include "swiftlet/integrate/integrator.hpp"

namespace swiftlet {

/// Keeps what is thinner than a cell from being erased by the rays that pass beside it.
///
/// A rod of 5 mm covers a twentieth of a cell of 10 cm, and the mean rule lets the other nineteen
/// outvote it. In the image it is a ridge: readings with something clearly farther, or nothing,
/// half a cell to both sides or above and below. A cell in which a frame shows kLeastHits such
/// readings ends the frame no lower than kGain steps above where it began; one that shows none is
/// left to the integrator, so what has gone is cleared as fast as ever. Real time: allocates
/// nothing after construction. The same map bits on any number of threads.
class ThinHits {
 public:
  static constexpr int kLeastHits = 3;
  static constexpr std::int32_t kGain = 60;
  static constexpr std::size_t kMostCells = 1U << 14;  ///< in one frame

  ThinHits();

  /// Before the integrator: finds the ridges of a frame.
  void collect(const DepthView& view, const RollingMap& map);
  /// After it: raises their cells. Returns how many.
  std::size_t protect(RollingMap& map);

  /// A reading is clearly behind another by so many cells, and so many of its deviations.
  static constexpr float kBehindCells = 1.5F, kBehindSigma = 6.0F;
  /// A ridge is looked for so far to the sides at least and at most.
  static constexpr float kLeastReach_px = 2.0F, kMostReach_px = 64.0F;

 private:
  static constexpr std::size_t kSlots = 2 * kMostCells;  // a power of two
  struct Slot {
    VoxelIndex cell;
    std::uint32_t frame = 0;  // the slot is empty in any other
    int hits = 0;
    LogOdds before = kUnknownCell;
  };
  /// A square of pixels; false: there is no ridge in it.
  [[nodiscard]] bool may_have_ridge(const PyramidTiles& tiles, int tile_u, int tile_v) const;
  void collect_tile(const DepthView& view, const PyramidTiles& tiles, int tile_u, int tile_v,
                    const RollingMap& map);
  void add_reading(const DepthView& view, int u, int v, const RollingMap& map);
  void add(const VoxelIndex& cell, const RollingMap& map);
  /// What the readings of one frame are compared with. Depths in device units.
  struct Limits {
    float half_cell_px;  // at a depth of one unit
    float least_behind, behind_per_square;

    /// How far to the side half a cell is, for a reading.
    [[nodiscard]] int reach_px(int z) const {
      const float reach = std::floor(half_cell_px / static_cast<float>(z)) + 1.0F;
      return static_cast<int>(std::clamp(reach, kLeastReach_px, kMostReach_px));
    }
    /// What is clearly behind a reading.
    [[nodiscard]] float far_behind(float z) const {
      return z + std::max(least_behind, behind_per_square * z * z);
    }
  };
  Limits limits_{};
  BorderedImage image_;
  std::vector<Slot> slots_;             // open addressing
  std::vector<std::uint32_t> touched_;  // slots of this frame, in the order of the pixels
  std::uint32_t frame_ = 0;
  WorkerTeam team_{1};
  DepthPyramid pyramid_;
};

}  // namespace swiftlet
