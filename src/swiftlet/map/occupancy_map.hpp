// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <concepts>

#include "swiftlet/base/voxel_index.hpp"
#include "swiftlet/map/block_window.hpp"
#include "swiftlet/map/log_odds_scale.hpp"
#include "swiftlet/map/voxel_block.hpp"

namespace swiftlet {

/// What can be asked, whoever holds the blocks: the live RollingMap, a MapSnapshot of it, a
/// BlockMap in memory (a loaded file, a copy), the ground station's mirror. The queries in query/
/// are templates over it.
///   voxel_m()   edge of a voxel [m]
///   scale()     how its voxels are read
///   extent()    a box of blocks outside of which nothing is known
///   find(b)     the block, or null where nothing is known
///   for_each_known_block(visit)   visit(BlockIndex, const VoxelBlock&) for every block there is
///   log_odds(v), occupancy(v), probability(v)   of one voxel or point: VoxelLookup gives them
template <class Map>
concept OccupancyMap = requires(const Map& map, const BlockIndex& index, const VoxelIndex& voxel,
                                const Eigen::Vector3d& p_world,
                                void (*visit)(const BlockIndex&, const VoxelBlock&)) {
  { map.voxel_m() } -> std::convertible_to<double>;
  { map.scale() } -> std::convertible_to<LogOddsScale>;
  { map.extent() } -> std::convertible_to<BlockWindow>;
  { map.find(index) } -> std::same_as<const VoxelBlock*>;
  map.for_each_known_block(visit);
  { map.log_odds(voxel) } -> std::same_as<QuantizedLogOdds>;
  { map.occupancy(p_world) } -> std::same_as<Occupancy>;
  { map.probability(p_world) } -> std::convertible_to<double>;
};

/// Gives a map (`class M : public VoxelLookup<M>`) the questions of one voxel or point.
///
/// Points are in metres in the world frame; one that is no place (NaN, beyond the grid's indices)
/// is unknown, as is everything outside the map. Thread safety: the map's. Cost: one find(). Does
/// not allocate.
template <class Map>
class VoxelLookup {
 public:
  /// The byte of a voxel; kUnknownVoxel where nothing is known.
  [[nodiscard]] QuantizedLogOdds log_odds(const VoxelIndex& voxel) const {
    const VoxelBlock* block = self().find(block_of(voxel));
    return block == nullptr ? kUnknownVoxel : block->voxels[offset_in_block(voxel)];
  }
  /// Free, occupied or unknown, by the map's own thresholds.
  [[nodiscard]] Occupancy occupancy(const VoxelIndex& voxel) const {
    return self().scale().classify(log_odds(voxel));
  }
  /// 0 to 1; 0.5 where nothing is known.
  [[nodiscard]] double probability(const VoxelIndex& voxel) const {
    return self().scale().probability(log_odds(voxel));
  }

  // The same of a point.
  /// The byte of the voxel around a point [m, world].
  template <std::convertible_to<Eigen::Vector3d> Point>
  [[nodiscard]] QuantizedLogOdds log_odds(const Point& p_world) const {
    constexpr double kFirstBeyond = 2147483648.0;  // an index is an int32
    const Eigen::Vector3d p = p_world;
    const double voxel_m = self().voxel_m();
    if (!(p.array().abs() < kFirstBeyond * voxel_m).all()) return kUnknownVoxel;
    return log_odds(voxel_containing(p, voxel_m));
  }
  /// Free, occupied or unknown, at a point [m, world].
  template <std::convertible_to<Eigen::Vector3d> Point>
  [[nodiscard]] Occupancy occupancy(const Point& p_world) const {
    return self().scale().classify(log_odds(p_world));
  }
  /// 0 to 1, at a point [m, world].
  template <std::convertible_to<Eigen::Vector3d> Point>
  [[nodiscard]] double probability(const Point& p_world) const {
    return self().scale().probability(log_odds(p_world));
  }

 private:
  [[nodiscard]] const Map& self() const { return static_cast<const Map&>(*this); }
};

}  // namespace swiftlet
