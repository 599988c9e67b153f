// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "swiftlet/base/worker_team.hpp"
#include "swiftlet/query/distance/distance_field_grid.hpp"
#include "swiftlet/query/distance/distance_kernels.hpp"

namespace swiftlet {

/// Scratch of the threads that work on layers, one a thread; all layers of a field use the same.
struct DistanceScratch {
  std::vector<std::uint8_t> column;
  std::vector<std::uint16_t> line;
};

/// Which set of voxels a layer measures the distance to.
struct DistanceTarget {
  bool is_flipped = false;           ///< the bits that are 0, not those that are 1
  bool is_outside_obstacle = false;  ///< whether what is outside the box belongs to the set
};

/// Exact squared Euclidean distance of every voxel of a box to the nearest voxel of one set, up to
/// a cap, kept up to date at the cost of what changes.
///
/// Three passes (Saito & Toriwaki 1994): along z the distance to the nearest obstacle of the same
/// column; along y the least of that squared + dy²; along x the least of that + dx². Each pass
/// keeps its result, so after a change only what a changed value may decide is worked out again:
/// a value v decides nothing farther away than sqrt(cap - v). What a pass finds unchanged is not
/// passed on. All is whole numbers, so the result is that of a field made from nothing, bit for
/// bit. Memory: 5 bytes a voxel. Thread safety: none; update() shares its work with a team.
class DistanceLayer {
 public:
  /// `cap`: the least square [voxels²] that is out of reach. REQUIRES: 1 <= cap <= 255².
  DistanceLayer(const DistanceGrid& grid, int cap, const DistanceTarget& target);

  /// Forgets all: the box, where the grid now is, is as what is outside.
  void clear(const DistanceGrid& grid);
  /// Follows a move of the box; what enters is as what is outside until it is touched.
  /// REQUIRES: both boxes overlap, and the bits of blocks in the room beside the box along x are as
  /// outside.
  void move(const BlockWindow& before, const DistanceGrid& now);
  /// The bits of a block in row `y` (position) of this vector (position) have changed.
  void touch(int vector, int y) {
    TodoBits::set(columns_.data() + static_cast<std::ptrdiff_t>(vector) * row_words_, y, y);
  }
  /// Works off what has been touched. Does not allocate.
  void update(const DistanceGrid& grid, const std::vector<ObstacleBits>& bits, WorkerTeam& team,
              std::vector<DistanceScratch>& scratch);

  /// By DistanceGrid::index() [voxels²]; cap or more: out of reach.
  [[nodiscard]] std::uint16_t squared(std::size_t index) const { return everywhere_[index]; }
  /// How the nearest one is found: the distance within the column [voxels], by padded_index().
  [[nodiscard]] std::uint8_t along_z(std::size_t padded) const { return along_z_[padded]; }
  /// ... and within the slice, by index() [voxels²].
  [[nodiscard]] std::uint16_t within_slice(std::size_t index) const { return within_slice_[index]; }

  [[nodiscard]] const DistanceTarget& target() const { return target_; }
  [[nodiscard]] int reach() const { return reach_; }
  [[nodiscard]] std::size_t memory_bytes() const;

 private:
  [[nodiscard]] DistanceArrays arrays(const DistanceGrid& grid, const ObstacleBits* bits);
  void move_along_x(const BlockWindow& before, const DistanceGrid& now);
  void leave_along_x(const DistanceArrays& a, std::int32_t block_x, const DistanceGrid& now,
                     std::ptrdiff_t z, std::ptrdiff_t y);
  void move_along_y(const BlockWindow& before, const DistanceGrid& now);
  void move_along_z(const BlockWindow& before, const DistanceGrid& now);
  void redo_slice(const DistanceGrid& grid, int z);
  void redo_columns(const DistanceGrid& grid);

  DistanceTarget target_;
  std::uint16_t cap_;
  int reach_;  // the least whole number whose square is cap_ or more
  int row_words_, line_words_;
  std::uint8_t outside_along_z_;
  std::uint16_t outside_;
  std::vector<std::uint8_t> reach_from_;
  std::vector<std::uint8_t> along_z_;
  std::vector<std::uint16_t> within_slice_, everywhere_;
  std::vector<std::uint64_t> columns_, rows_todo_, lines_todo_;
  std::vector<std::uint8_t> has_lines_;
};

/// The least whole number whose square is `cap` or more.
[[nodiscard]] int distance_reach(int cap);

}  // namespace swiftlet
