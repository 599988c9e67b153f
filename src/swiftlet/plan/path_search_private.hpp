// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "swiftlet/plan/motion_check.hpp"
#include "swiftlet/plan/plan_options.hpp"

namespace swiftlet {

/// What OMPL is asked.
struct PathQuestion {
  const MotionCheck& check;
  Eigen::Vector3d from, to;  ///< both clear
  SpaceBox bounds;           ///< that hold both
  const PlanOptions& options;
  std::vector<Eigen::Vector3d> guide{};  ///< a way on the grid to look around, if there is one
};

/// A way from corner to corner, each leg clear; empty if none was found in the iterations allowed.
/// Errors: kUnsupported if this build has no OMPL, or with OMPL's own words.
[[nodiscard]] Expected<std::vector<Eigen::Vector3d>> search_path(const PathQuestion& question);

}  // namespace swiftlet
