// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/base/worker_team.hpp"
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
  static constexpr std::int32_t kGain = 45;
  static constexpr std::size_t kMostCells = 1U << 14;  ///< in one frame

  ThinHits();

  /// Before the integrator: finds the ridges of a frame.
  void collect(const DepthView& view, const RollingMap& map);
  /// After it: raises their cells. Returns how many.
  std::size_t protect(RollingMap& map);

  /// What a reading of some depth is compared with.
  struct Limits {
    std::uint16_t reach_px;  ///< half a cell to the side
    std::uint16_t far;       ///< what is clearly behind it, in device units
  };

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
  void collect_tile(const DepthView& view, int tile_u, int tile_v, const RollingMap& map);
  void add(const VoxelIndex& cell, const RollingMap& map);
  void look_up_limits(const DepthView& view, double voxel_m);

  std::vector<Limits> limits_;          // of every depth, for the numbers below
  std::array<double, 3> limits_of_{};   // changes only with the camera
  std::vector<Slot> slots_;             // open addressing
  std::vector<std::uint32_t> touched_;  // slots of this frame, in the order of the pixels
  std::uint32_t frame_ = 0;
  WorkerTeam team_{1};
  DepthPyramid pyramid_;
};

}  // namespace swiftlet
