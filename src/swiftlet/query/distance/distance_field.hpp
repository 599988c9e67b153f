// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/query/distance/distance_field_grid.hpp"
#include "swiftlet/query/distance/distance_field_layer.hpp"

namespace swiftlet {

/// What a planner keeps away from.
enum class Obstacles : std::uint8_t {
  kOccupied,  ///< what is known to be occupied; unknown space counts as free
  kNotFree,   ///< everything that is not known to be free: unknown space is an obstacle
};

/// How far an answer of a distance field may be trusted.
enum class DistanceStatus : std::uint8_t {
  kKnown,        ///< the distance is that to the nearest obstacle
  kUnknownHere,  ///< so it is, but the place itself was never seen
  kBeyondReach,  ///< no obstacle within max_distance_m, which is what the distance says
  kOutside,      ///< not in the box of the field: the distance is 0
};

/// What the field covers, and what counts as an obstacle.
struct DistanceFieldOptions {
  double max_distance_m = 2.0;  ///< the reach: greater distances are this one; < 255 voxels
  bool occupied = true;         ///< answer for Obstacles::kOccupied
  bool not_free = true;         ///< answer for Obstacles::kNotFree
  /// Distances inside obstacles, too: less than zero, by how deep. Twice the memory and time.
  bool is_signed = false;
  /// The box around the middle of the window, or around the place that update() is told, rounded up
  /// to whole blocks and cut to the window; 0: as long as the window.
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();
  OccupancyThresholds thresholds{};  ///< where belief becomes a claim
  int threads = 1;  ///< that update() shares its work with; the bits are the same with any number
};

/// An answer of distance().
struct DistanceAnswer {
  double distance_m;      ///< to the nearest obstacle, see status
  DistanceStatus status;  ///< what the number means
};

/// An answer with a direction.
struct DistanceSample {
  double distance_m;         ///< to the nearest obstacle
  Eigen::Vector3d gradient;  ///< of distance_m by place, no unit, world frame: away from obstacles
  DistanceStatus status;     ///< of the voxel that the place is in
};

/// Exact Euclidean distance from every voxel of a box to the nearest obstacle, kept up to date at
/// the cost of what changes, and never a ghost: after each update() it equals one made from nothing
/// of the same snapshot, bit for bit.
///
/// Distances are from centre to centre of voxels, up to max_distance_m, in metres. 0 in an
/// obstacle; or, if signed, the distance to the nearest voxel that is none, less one voxel, below
/// zero: along a line through a surface values step 2, 1, 0, -1, -2 voxels. A point is anywhere in
/// its voxel, and an obstacle fills its own, so the true clearance of a point is at least
/// `distance_m - conservative_margin_m()`, which is sqrt(3) voxels; so it is for a value between
/// voxels, see sample(). What is outside the box is unknown, hence an obstacle to kNotFree and
/// free space to kOccupied: near the faces of a box, kOccupied does not know what is beyond.
///
/// Memory: 5 bytes a voxel and kind of obstacles, twice that if signed; and a quarter of a byte.
/// Thread safety: update() while nobody asks; questions from any number of threads. See
/// DistanceFieldThread for a field that is kept up to date beside its readers.
class DistanceField {
 public:
  /// For maps of these voxels and of windows of this size (RollingMap::voxel_m() and window()).
  /// Errors: kInvalidConfig if an option is impossible; kOutOfMemory.
  [[nodiscard]] static Expected<DistanceField> create(double voxel_m, const BlockIndex& window_size,
                                                      const DistanceFieldOptions& options);

  /// Brings the field to the state of a snapshot; the box moves with the window. Any snapshot of
  /// any map will do; one of the map it had last, not much older or newer, costs least. REQUIRES:
  /// map.voxel_m() is that of create(). Does not allocate. Cost: O(blocks in the box) words, then
  /// what changed within reach.
  void update(const MapSnapshot& map);
  /// The same with the box around a place [m, world], as far as the window reaches. It follows by
  /// whole blocks, and not before the place is three quarters of one off.
  void update(const MapSnapshot& map, const Eigen::Vector3d& around_world);

  /// Edge of a voxel [m]
  [[nodiscard]] double voxel_m() const { return voxel_m_; }
  /// As given.
  [[nodiscard]] const DistanceFieldOptions& options() const { return options_; }
  /// MapSnapshot::frame_count() of the last update(); 0 before.
  [[nodiscard]] std::uint64_t frame_count() const { return frame_count_; }
  /// The box of blocks that it covers now.
  [[nodiscard]] const BlockWindow& box() const { return grid_.box(); }
  /// false before the first update(), too.
  [[nodiscard]] bool contains(const VoxelIndex& voxel) const {
    return has_map_ && box().contains(block_of(voxel));
  }
  /// What to take off a distance for what is within voxels [m].
  [[nodiscard]] double conservative_margin_m() const { return std::sqrt(3.0) * voxel_m_; }

  // Questions. REQUIRES of each: options() had these obstacles.

  /// From the centre of a voxel. Cost: about 10 ns.
  [[nodiscard]] DistanceAnswer distance(const VoxelIndex& voxel, Obstacles obstacles) const;
  /// At any point [m, world]: trilinear between the centres of the eight voxels around it, and its
  /// derivative. The value is continuous, with slope at most sqrt(3); the gradient jumps where a
  /// point passes from between eight centres to between eight others. In the outer half of the
  /// voxels on the rim of the box the value goes on as at their centres. For points between
  /// centres, too, the clearance is at least distance_m - conservative_margin_m(): the value is a
  /// mean of distances, weighted so that their centres are sqrt(3)/2 voxels away at most in that
  /// mean, and an obstacle reaches sqrt(3)/2 from its centre. Cost: about 50 ns.
  [[nodiscard]] DistanceSample sample(const Eigen::Vector3d& p_world, Obstacles obstacles) const;
  /// The nearest obstacle, one of them if several are as near; always the same one for the same
  /// distances. It may be a voxel just outside the box. Nullopt outside and beyond reach.
  /// Cost: O(max_distance_m / voxel_m), below a microsecond.
  [[nodiscard]] std::optional<VoxelIndex> closest_obstacle(const VoxelIndex& voxel,
                                                           Obstacles obstacles) const;

  /// From obstacle to voxel, squared [voxels²]; nullopt beyond reach. REQUIRES: contains(voxel).
  [[nodiscard]] std::optional<int> squared_voxels(const VoxelIndex& voxel,
                                                  Obstacles obstacles) const;

  /// Of all that it holds [bytes]
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  /// Of one kind of obstacles.
  struct Kind {
    std::vector<ObstacleBits> bits;       ///< by place of blocks
    std::optional<DistanceLayer> layer;   ///< unless it is not asked for
    std::optional<DistanceLayer> inside;  ///< to what is no obstacle; if signed
  };

  DistanceField(double voxel_m, const BlockIndex& box_size, int cap,
                const DistanceFieldOptions& options);
  void follow(const MapSnapshot& map, const BlockIndex& first);
  void move_to(const BlockIndex& first);
  void forget(const BlockIndex& first);
  void read_block(const MapSnapshot& map, const BlockIndex& index, std::size_t place);
  void replace_bits(Kind& kind, std::size_t place, const ObstacleBits& bits,
                    const BlockIndex& index);
  template <class Visit>
  void for_each_layer(Visit&& visit);

  [[nodiscard]] const Kind& kind(Obstacles obstacles) const;
  [[nodiscard]] double value_m(const Kind& kind, std::size_t index) const;
  [[nodiscard]] bool is_obstacle(const Kind& kind, const VoxelIndex& voxel) const;
  [[nodiscard]] DistanceStatus status_at(const Kind& kind, const DistanceGrid::Place& place) const;

  double voxel_m_;
  DistanceFieldOptions options_;
  std::uint16_t cap_;          // the least square [voxels²] that is out of reach
  std::vector<float> metres_;  // by square, 0 to cap_
  ObstacleClasses unknown_{};  // of a block that the map does not hold
  DistanceGrid grid_;
  std::array<Kind, 2> kinds_;            // by Obstacles
  std::vector<std::uint64_t> versions_;  // of the blocks as they were read, by place
  std::unique_ptr<WorkerTeam> team_;
  std::vector<DistanceScratch> scratch_;
  std::weak_ptr<const void> map_;  // which the versions are of
  bool has_map_ = false;
  std::uint64_t frame_count_ = 0;
};

}  // namespace swiftlet
