// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/score/score_report.hpp"

#include <algorithm>

namespace swiftlet::eval {

void add_value(ScoreReport& report, std::size_t map, const std::string& score,
               const ScoreValue& value) {
  auto row = std::ranges::find_if(report.rows, [&](const ScoreRow& r) {
    return r.score == score && r.meaning.name == value.name;
  });
  if (row == report.rows.end()) {
    report.rows.push_back({score, value, std::vector<std::optional<double>>(report.maps.size())});
    row = report.rows.end() - 1;
  }
  row->values[map] = value.value;
}

}  // namespace swiftlet::eval
