// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "swiftlet/integrate/depth_view.hpp"
#include "swiftlet/integrate/image/ridge_kernels.hpp"
#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet {

/// Keeps what is thinner than a voxel from being erased by the rays that pass beside it.
///
/// A rod of 5 mm covers a twentieth of a voxel of 10 cm, and the mean rule lets the other nineteen
/// outvote it. In the image it is a ridge: readings with something clearly farther, or nothing,
/// half a voxel to both sides or above and below. A voxel in which a frame shows kLeastHits such
/// readings ends the frame no lower than kGain steps above where it began; one that shows none is
/// left to the integrator, so what has gone is cleared as fast as ever. Real time: allocates
/// nothing after construction. The same map bits on any number of threads.
class ThinObstacleFilter {
 public:
  static constexpr int kLeastHits = 3;
  static constexpr std::int32_t kGain = 60;
  static constexpr std::size_t kMostVoxels = 1U << 14;  ///< in one frame

  ThinObstacleFilter();

  /// Before the integrator: finds the ridges of a frame.
  void collect(const DepthView& view, const RollingMap& map);
  /// After it: raises their voxels. Returns how many.
  std::size_t protect(RollingMap& map);

  /// Scratch memory [bytes].
  [[nodiscard]] std::size_t memory_bytes() const {
    return image_.memory_bytes() + slots_.capacity() * sizeof(Slot) +
           touched_.capacity() * sizeof(touched_[0]);
  }

  /// A reading is clearly behind another by so many voxels, and so many of its deviations.
  static constexpr float kBehindVoxels = 1.5F, kBehindSigma = 6.0F;

 private:
  static constexpr std::size_t kSlots = 2 * kMostVoxels;  // a power of two
  struct Slot {
    VoxelIndex voxel;
    std::uint32_t frame = 0;  // the slot is empty in any other
    int hits = 0;
    QuantizedLogOdds before = kUnknownVoxel;
  };
  void collect_tile(const DepthView& view, const DepthRangeTiles& tiles, int tile_u, int tile_v,
                    const RollingMap& map);
  void add_reading(const DepthView& view, int u, int v, const RollingMap& map);
  void add(const VoxelIndex& voxel, const RollingMap& map);
  RidgeLimits limits_{};
  BorderedImage image_;
  std::vector<Slot> slots_;             // open addressing
  std::vector<std::uint32_t> touched_;  // slots of this frame, in the order of the pixels
  std::uint32_t frame_ = 0;
};

}  // namespace swiftlet
