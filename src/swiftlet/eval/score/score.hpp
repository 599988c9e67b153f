// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "swiftlet/base/registry.hpp"
#include "swiftlet/eval/truth/reaction.hpp"
#include "swiftlet/eval/truth/thin_voxels.hpp"
#include "swiftlet/eval/truth/truth.hpp"

namespace swiftlet::eval {

/// A map at the end of a flight, and what the flight was.
struct Judged {
  const Truth& truth;    ///< what there is
  const Claims& claims;  ///< of the map, over truth.voxels().box()
  /// Voxels that were ever called occupied at a look, once a second of the flight.
  const DenseGrid<std::uint8_t>& ever_occupied;
  /// The voxels that another map knows, to compare over the same; null if there is no such map.
  const Claims* reference = nullptr;
  double flight_s = 0.0;                 ///< how long the flight was
  std::span<const ThinVoxel> thin{};     ///< voxels of thin objects, with how near they were seen
  const Reactions* reactions = nullptr;  ///< null where nothing moves
};

/// How a value is read.
enum class Unit : std::uint8_t { kShare, kMetres, kDegrees, kCount, kPerMinute, kFrames };

/// One number that says how right a map is.
struct ScoreValue {
  std::string name;              ///< in `swiftlet score`
  double value = 0.0;            ///< in its unit
  Unit unit = Unit::kShare;      ///< of `value`
  bool higher_is_better = true;  ///< false: less is better
  std::size_t of = 0;            ///< how many things it was counted over
};

/// A voxel that a planner must hear of one by one.
struct Finding {
  VoxelIndex voxel;       ///< which one
  std::string what;       ///< what is there
  bool is_warned = true;  ///< a neighbour is called occupied, so that a margin of one voxel saves
};

/// What one score tells of a map.
struct ScoreResult {
  std::vector<ScoreValue> values;  ///< empty if the flight has nothing to judge by
  std::vector<Finding> findings;   ///< solid voxels that are called free
};

/// A score is one file and one line in scores.cpp.
using ComputeScore = ScoreResult (*)(const Judged& judged);

/// All scores there are.
[[nodiscard]] std::span<const Registered<ComputeScore>> scores();

/// part / whole, and how many the whole is. 1 if there is none: nothing was done wrong.
[[nodiscard]] ScoreValue share(std::string name, std::size_t part, std::size_t whole,
                               bool higher_is_better = true);

}  // namespace swiftlet::eval
