// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "swiftlet/eval/bench/bench_rows.hpp"
#include "swiftlet/eval/bench/bench_tables.hpp"

namespace swiftlet::app {

[[nodiscard]] std::string machine_text(const eval::Machine& machine);

/// An aligned table, for people.
[[nodiscard]] std::string rows_text(std::span<const eval::BenchRow> rows);
/// {"machine": ..., "rows": [...]}, for machines; null where there is no OctoMap to compare with.
[[nodiscard]] nlohmann::ordered_json rows_json(const eval::Machine& machine,
                                               std::span<const eval::BenchRow> rows);

[[nodiscard]] std::string tables_text(const eval::ThesisTables& tables);
[[nodiscard]] nlohmann::ordered_json tables_json(const eval::ThesisTables& tables);

}  // namespace swiftlet::app
