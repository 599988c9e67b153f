// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet::sim {

/// What may be asked of a random scene.
struct RandomSceneOptions {
  std::optional<double> size_m{};  ///< longer side of the ground, 12 .. 80; default: the kind's own
  double density = 1.0;            ///< 0 nothing but what must be, 1 usual, at most 3
  double thinnest_m = 0.010;       ///< diameter or thickness of the thinnest thing, 0.002 .. 0.05
};

/// What is to be done in a scene. [world]
struct SceneTask {
  Eigen::Vector3d start_m;
  double start_yaw_rad;  ///< where the vehicle looks at first: into the scene
  Eigen::Vector3d goal_m;
  /// Where a vehicle may be: inside the walls, or over the ground and below the sky.
  Eigen::AlignedBox3d bounds_m;
  /// The proof that there is a way: a polyline from start to goal, all of whose points are farther
  /// than kWayClearance_m from every surface and within the bounds.
  std::vector<Eigen::Vector3d> way_m;
};

/// A scene that nobody tuned on, and a task in it. The flight of the scene is that of a careful
/// pilot along the way, from start to goal. World frame: z up, metres.
struct GeneratedScene {
  Scene scene;
  SceneTask task;
};

/// Room around the way: for a vehicle of 0.4 m that plans in cells of 0.1 m with a margin.
inline constexpr double kWayClearance_m = 0.5;

/// Draws a scene of a kind ("forest"): the same kind, seed and options give the same scene to the
/// bit. A draw without a way is thrown away and drawn anew, less densely each time. Errors: kUsage
/// for an unknown kind (naming those there are) and for options out of range; kInvalidConfig if
/// no draw had a way. Cost: a second or two a draw.
[[nodiscard]] Expected<GeneratedScene> generate(std::string_view kind, std::uint64_t seed,
                                                const RandomSceneOptions& options = {});

}  // namespace swiftlet::sim
