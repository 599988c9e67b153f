// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swiftlet::eval {

/// One line of a figure.
struct Curve {
  std::string name;
  std::vector<std::pair<double, double>> points;
  bool is_measured = false;  ///< drawn as points
};

/// A figure of the thesis, redrawn: curves, or a map of voxels, row by row from below.
struct Figure {
  std::string name;  ///< of its files
  std::string title;
  std::string x_label, y_label;
  std::vector<Curve> curves{};
  std::vector<std::vector<double>> voxels{};  ///< 0 free .. 127 unknown .. 255 occupied
  double x0 = 0.0, y0 = 0.0, voxel = 1.0;     ///< middle of the first voxel, and their distance
};

}  // namespace swiftlet::eval
