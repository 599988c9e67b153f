// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "swiftlet/eval/score/score_report.hpp"

namespace swiftlet::app {

/// An aligned table, for people; of the findings the first ones, those that no neighbour warns of
/// before others.
[[nodiscard]] std::string score_text(const eval::ScoreReport& report);
/// Everything, for machines. Shares are fractions, lengths metres.
[[nodiscard]] nlohmann::ordered_json score_json(const eval::ScoreReport& report);

}  // namespace swiftlet::app
