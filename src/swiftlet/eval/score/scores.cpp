// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <array>
#include <utility>

#include "swiftlet/eval/score/score.hpp"

// A score is one file, which ends in score_<name>(), and one line here.
#define SWIFTLET_SCORES(X)                                                                    \
  X(occupied, "precision and recall of occupied voxels, exactly and within one voxel")        \
  X(free, "voxels called free that hold matter, the deadly ones; empty ones called free")     \
  X(near_surfaces, "both errors near surfaces, over the voxels that the reference map knows") \
  X(unknown, "never-seen voxels that are left unknown")                                       \
  X(surface, "where lines of sight meet the map, against the true surface")                   \
  X(walls, "straightness of walls and angles of corners")                                     \
  X(phantoms, "occupied voxels with nothing near, per minute")                                \
  X(thin, "recall of thin objects by diameter and distance")                                  \
  X(movers, "frames until what comes is occupied and what has gone is free")

namespace swiftlet::eval {

#define SWIFTLET_DECLARE(name, summary) ScoreResult score_##name(const Judged& judged);
SWIFTLET_SCORES(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const Registered<ComputeScore>> scores() {
#define SWIFTLET_LINE(name, summary) Registered<ComputeScore>{#name, summary, score_##name},
  static constexpr std::array kScores{SWIFTLET_SCORES(SWIFTLET_LINE)};
#undef SWIFTLET_LINE
  return kScores;
}

ScoreValue share(std::string name, std::size_t part, std::size_t whole, bool higher_is_better) {
  const double none = higher_is_better ? 1.0 : 0.0;
  const double value = whole == 0 ? none : static_cast<double>(part) / static_cast<double>(whole);
  return {std::move(name), value, Unit::kShare, higher_is_better, whole};
}

}  // namespace swiftlet::eval
