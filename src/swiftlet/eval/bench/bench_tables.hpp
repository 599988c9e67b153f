// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <vector>

#include "swiftlet/eval/bench/bench_workload.hpp"
#include "swiftlet/pipeline/mapper_config.hpp"

namespace swiftlet::eval {

inline constexpr double kThesisTablesVoxel_m = 0.2;  ///< table 4.1

/// One line of a table of the thesis, and the same on this machine.
struct ThesisLine {
  std::string what;
  double thesis_ms = 0.0;
  double rays_ms = 0.0;        ///< median, the thesis's method, written anew
  double projective_ms = 0.0;  ///< median, our integrator in its place; 0 where there is none
};

/// Tables 4.2 (function times) and 4.3 (mapping times) of the thesis, for this machine.
struct ThesisTables {
  std::string workload;
  std::vector<ThesisLine> functions;
  std::vector<ThesisLine> mapping;
};

/// Measures both, interleaved. `config`: sensor and range; the tables choose the rest.
/// Errors: those of Mapper::create().
[[nodiscard]] Expected<ThesisTables> measure_thesis_tables(const Workload& workload,
                                                           MapperConfig config,
                                                           const ProgressFunction& progress = {});

}  // namespace swiftlet::eval
