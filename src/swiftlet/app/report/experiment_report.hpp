// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "swiftlet/eval/thesis/experiment.hpp"

namespace swiftlet::app {

/// Writes FOLDER/NAME.csv and NAME.gp for a figure and, with gnuplot, NAME.svg and NAME.png, black
/// on white.
/// Returns the SVG; empty without gnuplot. Errors: kIo.
[[nodiscard]] Expected<std::string> draw_figure(const eval::Figure& figure,
                                                const std::string& folder);

/// What stands above a report.
struct ReportHead {
  std::string title = "Experiments of the thesis";
  std::string verdict = "reproduced, on the simulated rig";  ///< "3 of 7 ..."
  std::string column = "experiment";                         ///< what its entries are
};

/// Writes FOLDER/report.html, one page that needs nothing else, and draws all figures.
/// Says so on standard error if there is no gnuplot to draw with. Errors: kIo.
[[nodiscard]] Status write_report(std::span<const eval::ExperimentRun> runs,
                                  const std::string& folder, const ReportHead& head = {});

/// {"experiments": [{"name", "passed", "expected", "got"}]}, one entry a check.
[[nodiscard]] nlohmann::ordered_json experiments_json(std::span<const eval::ExperimentRun> runs);

}  // namespace swiftlet::app
