// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "swiftlet/eval/bench/bench_race.hpp"

namespace swiftlet::eval {

/// What the times were taken on and with.
struct Machine {
  std::string cpu;
  unsigned cores = 0;  ///< hardware threads
  std::string compiler;
  std::string build_type;
  std::string swiftlet;  ///< version
};
[[nodiscard]] Machine this_machine();

/// One line of the result. Times are of the measured frames, from the raw image to the map.
struct BenchRow {
  std::string workload;
  double cell_m = 0.0;
  std::string integrator;
  int threads = 1;
  std::size_t frames = 0;
  double min_ms = 0.0;
  double median_ms = 0.0;
  double p99_ms = 0.0;
  double mpixel_s = 0.0;  ///< pixels of the raw image per median time
  std::size_t map_bytes = 0;
  std::optional<double> speedup_vs_octomap_plain;  ///< ratio of the medians of the same race
  std::optional<double> speedup_vs_octomap_discretised;
};

inline constexpr const char* kOctomapPlain = "octomap_plain";
inline constexpr const char* kOctomapDiscretised = "octomap_discretised";

/// The rows of one race. `suffix` goes behind the workload's name.
[[nodiscard]] std::vector<BenchRow> rows_of(const Workload& workload, double cell_m,
                                            const std::vector<Runner>& runners,
                                            const std::string& suffix = {});

}  // namespace swiftlet::eval
