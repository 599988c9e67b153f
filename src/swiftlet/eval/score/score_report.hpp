// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

/// One score of all maps.
struct ScoreRow {
  std::string score;                            ///< name in scores(), or "leave_out"
  ScoreValue meaning;                           ///< name, unit, and which way is better
  std::vector<std::optional<double>> values{};  ///< one a map; absent where it has none
};

/// How right maps are that were made from the same frames.
struct ScoreReport {
  std::string source;                            ///< address
  double voxel_m = 0.0;                          ///< edge of a voxel of all maps
  std::size_t frames = 0;                        ///< that each was made of
  double flight_s = 0.0;                         ///< how long it was flown; 0 of a recording
  std::vector<std::string> maps;                 ///< names
  std::vector<ScoreRow> rows{};                  ///< in the order of their first value
  std::vector<std::vector<Finding>> findings{};  ///< of each map: solid voxels called free
  std::string intrinsics{};  ///< of recordings: where those of the camera came from
};

/// Books a value of the map of that number; rows appear in the order of their first value.
void add_value(ScoreReport& report, std::size_t map, const std::string& score,
               const ScoreValue& value);

}  // namespace swiftlet::eval
