// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/random/generated_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "swiftlet/sim/random/clear_way.hpp"
#include "swiftlet/sim/random/scene_draft.hpp"
#include "swiftlet/sim/random/scene_kinds.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kAttempts = 30;
constexpr double kThinning = 0.9;  // of the density, from draw to draw

Status check(const RandomSceneOptions& options) {
  const auto refuse = [](std::string what) {
    return fail(ErrorCode::kUsage, "random scene", std::move(what));
  };
  if (options.size_m && !(*options.size_m >= 12.0 && *options.size_m <= 80.0))
    return refuse("its size must be from 12 to 80 m");
  if (!(options.density >= 0.0 && options.density <= 3.0))
    return refuse("its density must be from 0 to 3");
  if (!(options.thinnest_m >= 0.002 && options.thinnest_m <= 0.05))
    return refuse("the thinnest things must be from 0.002 to 0.05 m");
  return Done{};
}

/// Of a leg; a steep one keeps the heading before it.
double heading_rad(const Vector3d& from, const Vector3d& to, double before_rad) {
  const Vector3d leg = to - from;
  return leg.head<2>().norm() < 0.2 ? before_rad : std::atan2(leg.y(), leg.x());
}

/// Stands while it turns and flies straight, so that the flight is where the way is.
Expected<Flight> careful_flight(const SceneTask& task) {
  constexpr double kSpeed_mps = 0.8, kTurn_radps = 0.8, kWait_s = 2.0;
  double time_s = 0.0, yaw_rad = task.start_yaw_rad;
  std::vector<Waypoint> waypoints;
  const auto be = [&](const Vector3d& p, double after_s) {
    time_s += after_s;
    waypoints.push_back({time_s, p, rotation_from_ypr(yaw_rad, 0.0, 0.0)});
  };
  be(task.way_m.front(), 0.0);
  be(task.way_m.front(), kWait_s);
  for (std::size_t i = 1; i < task.way_m.size(); ++i) {
    const Vector3d &from = task.way_m[i - 1], &to = task.way_m[i];
    const double before_rad = std::exchange(yaw_rad, heading_rad(from, to, yaw_rad));
    const double turned_rad =
        std::abs(std::remainder(yaw_rad - before_rad, 2.0 * std::numbers::pi));
    be(from, std::max(0.5, turned_rad / kTurn_radps));
    be(to, std::max(0.5, (to - from).norm() / kSpeed_mps));
  }
  return Flight::create(std::move(waypoints));
}

/// A scene without a way is nullopt.
Expected<std::optional<GeneratedScene>> with_way(SceneDraft draft) {
  auto world = RayCaster::create(draft.scene);
  if (!world) return forward_error(std::move(world));
  SceneTask& task = draft.task;
  auto way = clear_way(*world, task.start_m, task.goal_m, {task.bounds_m, kWayClearance_m});
  if (!way) return std::nullopt;
  task.way_m = std::move(*way);
  task.goal_m = task.way_m.back();
  auto flight = careful_flight(task);
  if (!flight) return forward_error(std::move(flight));
  draft.scene.flight = std::move(*flight);
  return GeneratedScene{std::move(draft.scene), std::move(draft.task)};
}

}  // namespace

Expected<GeneratedScene> generate(std::string_view kind, std::uint64_t seed,
                                  const RandomSceneOptions& options) {
  if (auto sane = check(options); !sane) return forward_error(std::move(sane));
  const auto entry = find_registered(scene_kinds(), kind, "kind of random scene");
  if (!entry) return tl::make_unexpected(entry.error());
  for (std::uint64_t attempt = 0; attempt < kAttempts; ++attempt) {
    const double density = options.density * std::pow(kThinning, static_cast<double>(attempt));
    SceneDraft draft(seed, attempt, options, density);
    entry->make(draft);
    draft.scene.name = fmt::format("random:{}?seed={}", kind, seed);
    draft.scene.about = entry->summary;
    auto scene = with_way(std::move(draft));
    if (!scene) return forward_error(std::move(scene));
    if (*scene) return *std::move(*scene);
  }
  return fail(ErrorCode::kInvalidConfig, "random scene",
              fmt::format("none of {} draws of '{}' has a way to the goal", kAttempts, kind),
              "ask for a lower density or another seed");
}

}  // namespace swiftlet::sim
