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
  std::string cpu;         ///< model, as the system tells it
  unsigned cores = 0;      ///< hardware threads
  std::string compiler;    ///< and its version
  std::string build_type;  ///< of CMake
  std::string swiftlet;    ///< version
};
/// The one that this runs on.
[[nodiscard]] Machine this_machine();

/// One line of the result. Times are of the measured frames, from the raw image to the map.
struct BenchRow {
  std::string workload;                            ///< name of the scene or recording
  double voxel_m = 0.0;                            ///< edge of a voxel [m]
  std::string integrator;                          ///< name
  int threads = 1;                                 ///< that share a frame
  std::size_t frames = 0;                          ///< that were fused
  double min_ms = 0.0;                             ///< of a frame
  double median_ms = 0.0;                          ///< of a frame
  double p99_ms = 0.0;                             ///< of a frame
  double mpixel_s = 0.0;                           ///< pixels of the raw image per median time
  std::size_t map_bytes = 0;                       ///< of the map alone, without scratch
  std::optional<double> speedup_vs_octomap_plain;  ///< ratio of the medians of the same race
  std::optional<double>
      speedup_vs_octomap_discretised;  ///< how many times as fast as OctoMap with one ray a voxel
};

/// The row of OctoMap as it is.
inline constexpr const char* kOctomapPlain = "octomap_plain";
/// The row of OctoMap with one ray a voxel.
inline constexpr const char* kOctomapDiscretised = "octomap_discretised";

/// The rows of one race. `suffix` goes behind the workload's name.
[[nodiscard]] std::vector<BenchRow> rows_of(const Workload& workload, double voxel_m,
                                            const std::vector<TimedSubject>& timed,
                                            const std::string& suffix = {});

}  // namespace swiftlet::eval
