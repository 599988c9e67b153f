// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cmath>
#include <vector>

#include "support/hand_made_map.hpp"
#include "support/seeds.hpp"
#include "swiftlet/query/distance/distance_field.hpp"
#include "swiftlet/query/ray_query.hpp"

namespace swiftlet::test {

inline constexpr double kPlanVoxel_m = 0.1;

/// Free space with boxes of matter and of the unknown in it, 4 x 4 x 2 m; free around the two
/// places that planners are asked about.
class Clutter {
 public:
  static inline const Eigen::Vector3d kFrom{-1.7, -1.7, 0.0}, kTo{1.7, 1.7, 0.1};

  explicit Clutter(Random& random) : map_(kPlanVoxel_m, {4, 4, 2}) {
    map_.fill_window(kUnknownVoxel);
    map_.fill({-2.2, -2.2, -1.0}, {2.2, 2.2, 1.0}, kFree);
    const int boxes = random.integer(5, 30);
    for (int i = 0; i < boxes; ++i) {
      const Eigen::Vector3d low = random.vector(-2.0, 2.0);
      map_.fill(low, low + random.vector(0.05, 1.2),
                random.chance(0.7) ? kOccupied : kUnknownVoxel);
    }
    for (const Eigen::Vector3d& p : {kFrom, kTo})
      map_.fill(p - Eigen::Vector3d::Constant(0.4), p + Eigen::Vector3d::Constant(0.4), kFree);
  }

  [[nodiscard]] HandMadeMap& made() { return map_; }

 private:
  HandMadeMap map_;
};

/// Whether a ball touches a voxel that stops it, found by trying every voxel near it.
inline bool touches_by_hand(const MapSnapshot& map, const Eigen::Vector3d& p, double radius_m,
                            UnknownSpace unknown) {
  const OccupancyThresholds thresholds;
  const double voxel = map.voxel_m();
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(radius_m + voxel);
  const VoxelIndex a = voxel_containing(p - around, voxel), b = voxel_containing(p + around, voxel);
  for (VoxelIndex v = a; v.z <= b.z; ++v.z) {
    for (v.y = a.y; v.y <= b.y; ++v.y) {
      for (v.x = a.x; v.x <= b.x; ++v.x) {
        const Occupancy state = thresholds.classify(map.log_odds(v));
        const bool stops = state == Occupancy::kOccupied ||
                           (state == Occupancy::kUnknown && unknown == UnknownSpace::kStops);
        if (!stops) continue;
        const Eigen::Vector3d low = Eigen::Vector3d(v.x, v.y, v.z) * voxel;
        const Eigen::Vector3d high = low + Eigen::Vector3d::Constant(voxel);
        if ((p - p.cwiseMax(low).cwiseMin(high)).norm() < radius_m) return true;
      }
    }
  }
  return false;
}

inline DistanceField field_of(const MapSnapshot& map, double reach_m = 1.5) {
  auto field = DistanceField::create(map.voxel_m(), map.window().size, {.max_distance_m = reach_m});
  field->update(map);
  return std::move(*field);
}

}  // namespace swiftlet::test
