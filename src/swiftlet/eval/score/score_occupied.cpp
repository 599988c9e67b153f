// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

ScoreResult score_occupied(const Judged& judged);

/// Precision: of the cells called occupied, those that hold matter, any at all, in themselves
/// (exact) or within one cell along each axis. Recall: of the solid cells whose surface was seen,
/// those called occupied, or with an occupied cell within one.
ScoreResult score_occupied(const Judged& judged) {
  const Truth& truth = judged.truth;
  std::size_t claimed = 0, right = 0, nearly_right = 0;
  std::size_t surface = 0, found = 0, nearly_found = 0;
  truth.cells().for_each([&](const VoxelIndex& v, const CellTruth& cell) {
    if (cell.is_swept) return;
    const bool is_occupied = judged.claims.at(v) == Occupancy::kOccupied;
    if (is_occupied) {
      ++claimed;
      right += cell.holds != Holds::kNothing ? 1 : 0;
      nearly_right +=
          any_within(v, 1, [&](const VoxelIndex& n) { return truth.holds_matter(n); }) ? 1 : 0;
    }
    if (!Truth::is_seen_surface(cell)) return;
    ++surface;
    found += is_occupied ? 1 : 0;
    nearly_found += is_occupied || is_occupied_within(judged.claims, v, 1) ? 1 : 0;
  });
  return {{share("occupied precision, exact", right, claimed),
           share("occupied precision, within 1 cell", nearly_right, claimed),
           share("occupied recall, exact", found, surface),
           share("occupied recall, within 1 cell", nearly_found, surface)},
          {}};
}

}  // namespace swiftlet::eval
