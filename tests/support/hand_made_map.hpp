// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <utility>

#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet::test {

inline constexpr QuantizedLogOdds kFree = 20;
inline constexpr QuantizedLogOdds kOccupied = 230;

/// A map for tests of what is asked of it: a window around the origin, filled by hand.
class HandMadeMap {
 public:
  HandMadeMap(double voxel_m, const Eigen::Vector3d& size_m)
      : map_(*RollingMap::create({.voxel_m = voxel_m, .size_m = size_m, .trigger_m = {1, 1, 1}})) {
    map_.recentre(Eigen::Vector3d::Zero(), nullptr);
  }

  [[nodiscard]] RollingMap& map() { return map_; }
  void set(const VoxelIndex& v, QuantizedLogOdds value) {
    if (!map_.window().contains(block_of(v))) return;
    map_.writable(block_of(v)).voxels[offset_in_block(v)] = value;
  }
  void set_at(const Eigen::Vector3d& p_world, QuantizedLogOdds value) {
    set(voxel_containing(p_world, map_.voxel_m()), value);
  }
  /// All voxels that a box touches.
  void fill(const Eigen::Vector3d& low, const Eigen::Vector3d& high, QuantizedLogOdds value) {
    const VoxelIndex a = voxel_containing(low, map_.voxel_m());
    const VoxelIndex b = voxel_containing(high, map_.voxel_m());
    for (VoxelIndex v = a; v.z <= b.z; ++v.z) {
      for (v.y = a.y; v.y <= b.y; ++v.y) {
        for (v.x = a.x; v.x <= b.x; ++v.x) set(v, value);
      }
    }
  }
  void fill_window(QuantizedLogOdds value) {
    for_each_block(map_.window(),
                   [&](const BlockIndex& b) { map_.writable(b).voxels.fill(value); });
  }
  [[nodiscard]] MapSnapshot snapshot() {
    auto snapshot = map_.snapshot({++frames_});
    EXPECT_TRUE(snapshot);
    return std::move(*snapshot);
  }

 private:
  RollingMap map_;
  std::uint64_t frames_ = 0;
};

}  // namespace swiftlet::test
