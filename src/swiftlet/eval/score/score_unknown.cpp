// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

ScoreResult score_unknown(const Judged& judged);

/// Of the voxels that were never seen, nor any of their neighbours, those that are left unknown.
ScoreResult score_unknown(const Judged& judged) {
  std::size_t never_seen = 0, honest = 0, freed = 0;
  judged.truth.voxels().for_each([&](const VoxelIndex& v, const VoxelTruth&) {
    if (!judged.truth.is_never_seen(v)) return;
    ++never_seen;
    honest += judged.claims.at(v) == Occupancy::kUnknown ? 1 : 0;
    freed += judged.claims.at(v) == Occupancy::kFree ? 1 : 0;
  });
  return {{share("unknown honesty", honest, never_seen),
           share("never-seen voxels called free", freed, never_seen, false)},
          {}};
}

}  // namespace swiftlet::eval
