// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <vector>

#include "swiftlet/eval/truth/dense_grid.hpp"
#include "swiftlet/eval/truth/movers.hpp"

namespace swiftlet::eval {

/// How soon a map notices that something has come into a voxel and that it has gone.
///
/// Frames are counted in which the voxel is seen: until it is occupied from the first one that
/// shows matter in it, and until it is free from the first one that looks through it again.
/// Something that passes within fewer than kJudgedAfter frames is not held against the map.
class Reactions {
 public:
  static constexpr int kJudgedAfter = 3;
  static constexpr int kFreedWithin = 10;  ///< frames, in which what has gone should be free

  /// REQUIRES: what observe() is given covers the same box.
  explicit Reactions(const VoxelBox& box) : states_(box, State{}) {}

  /// One frame: what is there, and what the map claims after it.
  void observe(const MoverSights& sights, const Claims& claims);

  /// Frames until occupied, of each voxel that something came into and that was noticed.
  [[nodiscard]] const std::vector<int>& until_occupied() const { return until_occupied_; }
  /// Frames until free, of each voxel that was occupied and that something left.
  [[nodiscard]] const std::vector<int>& until_free() const { return until_free_; }
  /// Voxels that were free within kFreedWithin frames, and those that were not, be they free later
  /// or never.
  [[nodiscard]] std::size_t freed() const;
  [[nodiscard]] std::size_t not_freed() const { return not_freed_; }
  /// Voxels that showed matter for kJudgedAfter frames or more and never became occupied.
  [[nodiscard]] std::size_t missed() const { return missed_; }
  /// Voxels that are still occupied by what has gone: looked through since, or never seen again.
  [[nodiscard]] std::size_t ghosts() const;

 private:
  enum class Phase : std::uint8_t { kEmpty, kComing, kThere, kGoing };
  struct State {
    Phase phase = Phase::kEmpty;
    int frames = 0;  // of the phase in which the voxel was seen
  };
  void observe(State& state, MoverSight sight, Occupancy claim);

  DenseGrid<State> states_;
  DenseGrid<Occupancy> last_claims_;
  DenseGrid<MoverSight> last_sights_;
  std::vector<int> until_occupied_;
  std::vector<int> until_free_;
  std::size_t missed_ = 0, not_freed_ = 0;
};

}  // namespace swiftlet::eval
