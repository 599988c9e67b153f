// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <vector>

#include "swiftlet/base/grid_ray.hpp"
#include "swiftlet/query/distance/distance_field.hpp"

namespace swiftlet {

/// What a ball needs around it for ReachableSpace::flood(), from the middle of its voxel to that of
/// the nearest obstacle: its radius, and half a diagonal to the obstacle's rim. [m]
[[nodiscard]] inline double room_for_ball_m(double radius_m, double voxel_m) {
  return radius_m + 0.5 * std::numbers::sqrt3 * voxel_m;
}

/// Where a vehicle can get to from a place, and how far it is: a flood over the voxels of a
/// distance field that have room enough, from voxel to voxel by faces and edges.
///
/// Path lengths are those of the grid, up to 9 % longer than the shortest way in a plane and 18 %
/// in space. Memory: 5 bytes a voxel of the field's box, kept from flood to flood. Thread safety:
/// one owner.
class ReachableSpace {
 public:
  /// Voxels count whose distance to the nearest obstacle, from centre to centre, is `least_m` or
  /// more; or, within twice that of where the flood begins, as much as there, if that is less; none
  /// of an obstacle.
  /// REQUIRES: the field has these obstacles. Cost: O(voxels of the box) to clear, O(voxels
  /// reached).
  void flood(const DistanceField& field, Obstacles obstacles, const Eigen::Vector3d& from_world,
             double least_m);

  /// The way to a voxel [m]; nullopt if there is none.
  [[nodiscard]] std::optional<double> path_m(const VoxelIndex& v) const;
  /// The same, to the voxel that holds a place [m, world].
  [[nodiscard]] std::optional<double> path_m(const Eigen::Vector3d& p_world) const;
  /// The voxels of a shortest way there, from where the flood began; empty if there is none.
  [[nodiscard]] std::vector<VoxelIndex> way_to(const VoxelIndex& v) const;
  /// Voxels that can be reached.
  [[nodiscard]] std::size_t voxel_count() const { return reached_; }

 private:
  struct Entry {
    VoxelIndex voxel;
    std::uint32_t cost;
  };
  [[nodiscard]] std::optional<std::size_t> index_of(const VoxelIndex& v) const;
  void spread(const DistanceField& field, Obstacles obstacles, const VoxelIndex& from,
              double least_m);
  void offer(const VoxelIndex& v, std::uint32_t cost);

  double voxel_m_ = 0.0;
  VoxelBox box_{};
  std::size_t row_ = 0, slab_ = 0;   // voxels of a row along x, of a layer
  std::vector<std::uint32_t> cost_;  // in tenths of a voxel
  std::vector<std::uint8_t> has_room_;
  std::vector<std::vector<Entry>> queue_;  // by cost, modulo its size (Dial, 1969)
  std::size_t reached_ = 0;
};

}  // namespace swiftlet
