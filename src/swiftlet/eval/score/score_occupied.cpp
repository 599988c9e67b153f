// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

ScoreResult score_occupied(const Judged& judged);

/// Precision: of the voxels called occupied, those that hold matter, any at all, in themselves
/// (exact) or within one voxel along each axis. Recall: of the solid voxels whose surface was seen,
/// those called occupied, or with an occupied voxel within one.
ScoreResult score_occupied(const Judged& judged) {
  const Truth& truth = judged.truth;
  std::size_t claimed = 0, right = 0, nearly_right = 0;
  std::size_t surface = 0, found = 0, nearly_found = 0;
  truth.voxels().for_each([&](const VoxelIndex& v, const VoxelTruth& voxel) {
    if (voxel.is_swept) return;
    const bool is_occupied = judged.claims.at(v) == Occupancy::kOccupied;
    if (is_occupied) {
      ++claimed;
      right += voxel.holds != Holds::kNothing ? 1 : 0;
      nearly_right +=
          any_within(v, 1, [&](const VoxelIndex& n) { return truth.holds_matter(n); }) ? 1 : 0;
    }
    if (!Truth::is_seen_surface(voxel)) return;
    ++surface;
    found += is_occupied ? 1 : 0;
    nearly_found += is_occupied || is_occupied_within(judged.claims, v, 1) ? 1 : 0;
  });
  return {{share("occupied precision, exact", right, claimed),
           share("occupied precision, within 1 voxel", nearly_right, claimed),
           share("occupied recall, exact", found, surface),
           share("occupied recall, within 1 voxel", nearly_found, surface)},
          {}};
}

}  // namespace swiftlet::eval
