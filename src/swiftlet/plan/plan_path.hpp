// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/base/expected.hpp"
#include "swiftlet/plan/plan_options.hpp"
#include "swiftlet/plan/planned_path.hpp"
#include "swiftlet/query/distance/distance_field.hpp"

namespace swiftlet {

/// Whether this build has OMPL, and plan_path() an answer.
[[nodiscard]] bool can_plan();

/// A way for the body from one place to another, searched by OMPL, then shortened and smoothed in
/// the distance field. sweep() says kClear of it, with the same policy; if a later map blocks it,
/// sweep() of that map tells where.
///
/// The body keeps the axes of the world on the way: for a vehicle that turns, give a shape that
/// holds it at any heading. Where the policy lets unknown space pass, the goal may lie outside the
/// window.
/// Errors: kUsage if a number cannot be used, the start or the goal lies outside the window or the
/// bounds, or the body is not clear there: it tells what it would touch, and where; kNotFound if
/// there is no way, or none was found; kUnsupported if this build has no OMPL.
/// Repeatable: the same map, question and seed give the same path. Thread safety: any. Cost: a
/// distance field of the window, unless one is given; then milliseconds if there is room, and at
/// most max_iterations. Allocates.
[[nodiscard]] Expected<PlannedPath> plan_path(const MapSnapshot& map, const BodyShape& body,
                                              const Eigen::Vector3d& from_world,
                                              const Eigen::Vector3d& to_world,
                                              const PlanOptions& options = {});

/// The same with a field that is at hand. REQUIRES: it is of a box as large as the window, with the
/// obstacles that stop the body. Errors: also kUsage if it belongs to another frame of the map.
[[nodiscard]] Expected<PlannedPath> plan_path(const MapSnapshot& map, const DistanceField& field,
                                              const BodyShape& body,
                                              const Eigen::Vector3d& from_world,
                                              const Eigen::Vector3d& to_world,
                                              const PlanOptions& options = {});

}  // namespace swiftlet
