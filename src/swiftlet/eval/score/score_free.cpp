// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

ScoreResult score_free(const Judged& judged);

/// Precision: of the voxels called free, those that are not solid. Each that is solid is listed
/// with what stands there. Recall: of the empty voxels that were looked through, those called free.
ScoreResult score_free(const Judged& judged) {
  const Truth& truth = judged.truth;
  std::size_t claimed = 0, slivers = 0, unwarned = 0, empty = 0, found = 0;
  ScoreResult result;
  truth.voxels().for_each([&](const VoxelIndex& v, const VoxelTruth& voxel) {
    if (voxel.is_swept) return;
    const bool is_free = judged.claims.at(v) == Occupancy::kFree;
    if (Truth::is_seen_empty(voxel)) {
      ++empty;
      found += is_free ? 1 : 0;
    }
    if (!is_free) return;
    ++claimed;
    slivers += voxel.holds == Holds::kSliver ? 1 : 0;
    if (voxel.holds != Holds::kSolid) return;
    const bool is_warned = is_occupied_within(judged.claims, v, 1);
    unwarned += is_warned ? 0 : 1;
    result.findings.push_back({v, truth.name_at(v), is_warned});
  });
  const std::size_t deadly = result.findings.size();
  result.values = {
      share("free precision", claimed - deadly, claimed),
      {"solid voxels called free", static_cast<double>(deadly), Unit::kCount, false, claimed},
      {"of these, without an occupied neighbour", static_cast<double>(unwarned), Unit::kCount,
       false, claimed},
      share("voxels called free with a sliver of matter", slivers, claimed, false),
      share("free recall", found, empty)};
  return result;
}

}  // namespace swiftlet::eval
