// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/base/registry.hpp"

namespace swiftlet::app {

/// One line of a figure.
struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
  bool is_measured = false;  ///< drawn as points
};

/// A figure of the thesis, redrawn: curves, or a map of cells, row by row from below.
struct Figure {
  std::string name;  ///< of its files
  std::string title;
  std::string x_label, y_label;
  std::vector<Curve> curves{};
  std::vector<std::vector<double>> cells{};  ///< 0 free .. 127 unknown .. 255 occupied
  double x0 = 0.0, y0 = 0.0, cell = 1.0;     ///< middle of the first cell, and their distance
};

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

using RunExperiment = Expected<ExperimentResult> (*)();

/// All experiments there are.
[[nodiscard]] std::span<const Registered<RunExperiment>> experiments();

/// An experiment that was run.
struct ExperimentRun {
  std::string name;
  std::string summary;
  ExperimentResult result;
  double seconds = 0.0;
};

/// Writes FOLDER/NAME.csv and NAME.gp for a figure and, with gnuplot, NAME.svg and NAME.png, black
/// on white.
/// Returns the SVG; empty without gnuplot. Errors: kIo.
[[nodiscard]] Expected<std::string> draw_figure(const Figure& figure, const std::string& folder);

/// What stands above a report.
struct ReportHead {
  std::string title = "Experiments of the thesis";
  std::string verdict = "reproduced, on the simulated rig";  ///< "3 of 7 ..."
  std::string column = "experiment";                         ///< what its entries are
};

/// Writes FOLDER/report.html, one page that needs nothing else, and draws all figures.
/// Says so on standard error if there is no gnuplot to draw with. Errors: kIo.
[[nodiscard]] Status write_report(std::span<const ExperimentRun> runs, const std::string& folder,
                                  const ReportHead& head = {});

/// {"experiments": [{"name", "passed", "expected", "got"}]}, one entry a check.
[[nodiscard]] nlohmann::ordered_json experiments_json(std::span<const ExperimentRun> runs);

}  // namespace swiftlet::app
