// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <utility>

#include "support/seeds.hpp"
#include "swiftlet/map/rolling_map.hpp"
#include "swiftlet/query/distance/distance_field.hpp"

namespace swiftlet::test {

inline constexpr double kRestlessVoxel_m = 0.25;

/// A map that changes at random: voxels, whole blocks, and where its window is.
class RestlessMap {
 public:
  RestlessMap(Random& random, const Eigen::Vector3d& size_m) : random_(random) {
    map_ = *RollingMap::create(
        {.voxel_m = kRestlessVoxel_m, .size_m = size_m, .trigger_m = {0.01, 0.01, 0.01}});
    map_->recentre(vehicle_, nullptr);
    for_each_block(map_->window(), [&](const BlockIndex& b) {
      if (random_.chance(0.6)) fill(b, 0.02);
    });
  }
  RollingMap& map() { return *map_; }

  MapSnapshot changed() {
    if (random_.chance(0.4)) move();
    const int edits = random_.integer(0, 4);
    for (int i = 0; i < edits; ++i) {
      const BlockIndex b = any_block();
      const double kind = random_.real(0, 1);
      if (kind < 0.2) {
        fill(b, random_.real(0, 0.1));
      } else if (kind < 0.3) {
        map_->writable(b).clear();
      } else {
        for (int n = random_.integer(1, 20); n > 0; --n)
          map_->writable(b).voxels[random_.integer<std::size_t>(0, kBlockVoxels - 1)] =
              any_value(0.4);
      }
    }
    return *map_->snapshot({++frames_});
  }

 private:
  void move() {
    const double farthest_m = random_.chance(0.1) ? 40.0 : random_.chance(0.3) ? 6.0 : 2.5;
    vehicle_ += random_.vector(-farthest_m, farthest_m);
    const BlockWindow before = map_->window();
    map_->recentre(vehicle_, nullptr);
    for_each_block_outside(map_->window(), before, [&](const BlockIndex& b) {
      if (random_.chance(0.5)) fill(b, 0.02);
    });
  }
  QuantizedLogOdds any_value(double occupied) {
    return random_.chance(occupied) ? 220 : random_.chance(0.1) ? kUnknownVoxel : 20;
  }
  void fill(const BlockIndex& b, double occupied) {
    for (QuantizedLogOdds& voxel : map_->writable(b).voxels) voxel = any_value(occupied);
  }
  BlockIndex any_block() {
    const BlockWindow& w = map_->window();
    return {w.first.x + random_.integer(0, w.size.x - 1),
            w.first.y + random_.integer(0, w.size.y - 1),
            w.first.z + random_.integer(0, w.size.z - 1)};
  }

  Random& random_;
  std::optional<RollingMap> map_;
  Eigen::Vector3d vehicle_{0.3, -0.2, 0.1};
  std::uint64_t frames_ = 0;
};

inline VoxelIndex any_voxel(Random& random, const BlockWindow& box) {
  const VoxelBox v = voxel_box(box);
  return {random.integer(v.first.x, v.last.x), random.integer(v.first.y, v.last.y),
          random.integer(v.first.z, v.last.z)};
}

inline DistanceField field_for(const RollingMap& map, const DistanceFieldOptions& options) {
  auto field = DistanceField::create(map.voxel_m(), map.window().size, options);
  EXPECT_TRUE(field) << field.error().text();
  return std::move(*field);
}

}  // namespace swiftlet::test
