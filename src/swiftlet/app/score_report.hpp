// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "swiftlet/eval/score.hpp"

namespace swiftlet::app {

/// One score of all maps.
struct ScoreRow {
  std::string score;  ///< name in eval::scores(), or "leave_out"
  eval::ScoreValue meaning;
  std::vector<std::optional<double>> values{};  ///< one a map; absent where it has none
};

/// How right maps are that were made from the same frames.
struct ScoreReport {
  std::string source;
  double voxel_m = 0.0;
  std::size_t frames = 0;
  double flight_s = 0.0;
  std::vector<std::string> maps;
  std::vector<ScoreRow> rows{};
  std::vector<std::vector<eval::Finding>> findings{};  ///< of each map: solid cells called free
  std::string intrinsics{};  ///< of recordings: where those of the camera came from
};

/// Books a value of the map of that number; rows appear in the order of their first value.
void add_value(ScoreReport& report, std::size_t map, const std::string& score,
               const eval::ScoreValue& value);

/// An aligned table, for people; of the findings the first ones, those that no neighbour warns of
/// before others.
[[nodiscard]] std::string score_text(const ScoreReport& report);
/// Everything, for machines. Shares are fractions, lengths metres.
[[nodiscard]] nlohmann::ordered_json score_json(const ScoreReport& report);

}  // namespace swiftlet::app
