// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

ScoreResult score_near_surfaces(const Judged& judged);

/// Voxels within so many of a solid one are near a surface.
constexpr std::int32_t kNear = 3;

/// The two errors that a noise model trades for each other, over the voxels that the reference map
/// knows (free or occupied): empty voxels called occupied, all of them and those near surfaces, and
/// solid voxels whose surface was seen called occupied. No values without a reference.
ScoreResult score_near_surfaces(const Judged& judged) {
  if (judged.reference == nullptr) return {};
  const Truth& truth = judged.truth;
  std::size_t empty = 0, filled = 0, near = 0, near_filled = 0, solid = 0, kept = 0, lost = 0;
  const auto is_solid = [&](const VoxelIndex& n) {
    return truth.voxels().contains(n) && truth.voxels().at(n).holds == Holds::kSolid;
  };
  truth.voxels().for_each([&](const VoxelIndex& v, const VoxelTruth& voxel) {
    if (judged.reference->at(v) == Occupancy::kUnknown) return;
    const Occupancy claim = judged.claims.at(v);
    if (Truth::is_seen_surface(voxel)) {
      ++solid;
      kept += claim == Occupancy::kOccupied ? 1 : 0;
      lost += claim == Occupancy::kFree ? 1 : 0;
    } else if (voxel.holds == Holds::kNothing && !voxel.is_swept) {
      const std::size_t is_filled = claim == Occupancy::kOccupied ? 1 : 0;
      ++empty;
      filled += is_filled;
      if (!Truth::is_seen_empty(voxel) || !any_within(v, kNear, is_solid)) return;
      ++near;
      near_filled += is_filled;
    }
  });
  return {{share("known voxels: empty ones called occupied", filled, empty, false),
           share("near surfaces: empty voxels called occupied", near_filled, near, false),
           share("near surfaces: seen solid voxels called occupied", kept, solid),
           share("near surfaces: seen solid voxels called free", lost, solid, false)},
          {}};
}

}  // namespace swiftlet::eval
