// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "swiftlet/query/sweep/sweep.hpp"

namespace swiftlet {

/// How plan_path() looks for a way.
enum class PathSearch : std::uint8_t {
  kFirst,  ///< the first way that is found (RRT-Connect), then shortened and smoothed: quick
  kBest,   ///< RRT*: all iterations are spent on ways that are shorter and keep farther away
};

/// A box of space [m, world].
struct SpaceBox {
  Eigen::Vector3d low;
  Eigen::Vector3d high;

  [[nodiscard]] bool contains(const Eigen::Vector3d& p_world) const {
    return (p_world.array() >= low.array()).all() && (p_world.array() <= high.array()).all();
  }
};

struct PlanOptions {
  SweepPolicy sweep{};  ///< when a place is clear: thresholds, unknown space, margin
  /// Beyond the margin, keep so far away where it costs little: the smoothing pushes a path away
  /// from what is nearer, and kBest pays for coming nearer. [m]
  double comfort_m = 0.3;
  /// Where the path may lead, such as the flying heights allowed; by default the whole window.
  std::optional<SpaceBox> bounds{};
  PathSearch search = PathSearch::kFirst;
  int max_iterations = 20'000;  ///< of the search: bounds its time, the same on every machine
  std::uint64_t seed = 1;       ///< the same map, question and seed give the same path
};

}  // namespace swiftlet
