// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <span>
#include <string>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/progress.hpp"
#include "swiftlet/base/registry.hpp"
#include "swiftlet/eval/figure.hpp"

namespace swiftlet::eval {

/// One result that the thesis has, and ours.
struct Check {
  std::string what;
  std::string expected;
  std::string got;
  bool is_passed = false;
};

struct ExperimentResult {
  std::vector<Check> checks;
  std::vector<Figure> figures{};

  [[nodiscard]] bool is_passed() const;
};

using RunExperiment = Expected<ExperimentResult> (*)(const ProgressFunction& progress);

/// All experiments there are.
[[nodiscard]] std::span<const Registered<RunExperiment>> experiments();

/// An experiment that was run.
struct ExperimentRun {
  std::string name;
  std::string summary;
  ExperimentResult result;
  double seconds = 0.0;
};

}  // namespace swiftlet::eval
