// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

ScoreResult score_phantoms(const Judged& judged);

/// Voxels called occupied that were looked through and have no matter within one voxel, per minute
/// of flight: at its end, and all that were there at one of the looks, once a second. Claims about
/// what nobody saw are the business of score_unknown().
ScoreResult score_phantoms(const Judged& judged) {
  const Truth& truth = judged.truth;
  std::size_t last = 0, ever = 0;
  truth.voxels().for_each([&](const VoxelIndex& v, const VoxelTruth& voxel) {
    if (judged.ever_occupied.at(v) == 0 || voxel.is_swept || voxel.through == 0) return;
    if (any_within(v, 1, [&](const VoxelIndex& n) { return truth.holds_matter(n); })) return;
    ++ever;
    last += judged.claims.at(v) == Occupancy::kOccupied ? 1 : 0;
  });
  const double minutes = judged.flight_s / 60.0;
  const auto rate = [&](std::string name, std::size_t count) {
    const double value = minutes > 0.0 ? static_cast<double>(count) / minutes : 0.0;
    return ScoreValue{std::move(name), value, Unit::kPerMinute, false, count};
  };
  return {{rate("phantom voxels at the end", last), rate("phantom voxels at any time", ever)}, {}};
}

}  // namespace swiftlet::eval
