// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/fly/fly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "swiftlet/fly/closed_loop_private.hpp"
#include "swiftlet/plan/plan_path.hpp"

namespace swiftlet {
namespace {

constexpr double kSight_m = 5.0;  // as far as a view counts on seeing

ViewCamera camera_of(const sim::Scene& scene, const PinholeIntrinsics& intrinsics) {
  ViewCamera camera;
  camera.hfov_rad = 2.0 * std::atan(0.5 * intrinsics.width() / intrinsics.fx());
  camera.vfov_rad = 2.0 * std::atan(0.5 * intrinsics.height() / intrinsics.fy());
  camera.max_range_m = kSight_m;
  camera.T_body_camera = scene.T_body_camera;
  return camera;
}

/// Finite, and where voxels can be counted.
bool is_place(const Eigen::Vector3d& p) {
  return p.allFinite() && p.cwiseAbs().maxCoeff() <= RollingMap::kMaxCoordinate_m;
}

Status check_options(const FlightStart& start, const FlyOptions& options) {
  if (!can_plan()) {
    return fail(ErrorCode::kUnsupported, "fly", "this build has no planner, as OMPL was not found",
                "install libompl-dev and configure with -DSWIFTLET_WITH_OMPL=ON");
  }
  const auto is_positive = [](double v) { return v > 0.0 && std::isfinite(v); };
  if (options.max_speed_mps > options.vehicle.max_speed_mps) {
    return fail(ErrorCode::kUsage, "fly",
                fmt::format("the vehicle does {} m/s at most", options.vehicle.max_speed_mps),
                "choose a lower speed");
  }
  if (options.goal_m && options.bounds && !options.bounds->contains(*options.goal_m)) {
    return fail(ErrorCode::kUsage, "fly", "the goal lies outside where the vehicle may be",
                "choose one inside the scene's bounds");
  }
  const bool is_sound =
      is_positive(options.max_speed_mps) && is_positive(options.body_radius_m) &&
      is_positive(options.max_acceleration_mps2) && is_positive(options.time_limit_s) &&
      is_positive(options.rate_hz) && options.margin_m >= 0.0 && options.comfort_m >= 0.0 &&
      is_place(start.position_m) && (!options.goal_m || is_place(*options.goal_m));
  if (is_sound) return Done{};
  return fail(ErrorCode::kUsage, "fly", "a place, a speed, a size or a time cannot be used",
              "give finite numbers above 0");
}

Expected<FlightWorld> world_of(const sim::Scene& scene, const FlightStart& start,
                               const BodyShape& body, const FlyOptions& options) {
  sim::VehicleState state;
  state.position_m = start.position_m;
  state.yaw_rad = start.yaw_rad;
  state.tilts = options.vehicle.tilts;
  auto truth = sim::TrueClearance::create(scene, body);
  if (!truth) return forward_error(std::move(truth));
  auto vehicle = sim::VehicleModel::create(options.vehicle, state, options.seed);
  if (!vehicle) return forward_error(std::move(vehicle));
  SteeredRigOptions instruments;
  instruments.seed = options.seed;
  instruments.rate_hz = options.rate_hz;
  instruments.has_noise = options.has_noise;
  auto rig = SteeredRig::create(scene, instruments, vehicle->state().T_world_body());
  if (!rig) return forward_error(std::move(rig));
  return FlightWorld{std::move(*truth), std::move(*rig), std::move(*vehicle)};
}

}  // namespace

Expected<FlightReport> fly(const sim::Scene& scene, const FlightStart& start,
                           const FlyOptions& options, FlownMapPtr map) {
  if (auto sound = check_options(start, options); !sound) return forward_error(std::move(sound));
  const auto body = BodyShape::sphere(options.body_radius_m);
  if (!body) return tl::make_unexpected(body.error());
  auto world = world_of(scene, start, *body, options);
  if (!world) return forward_error(std::move(world));
  if (world->truth.clearance_m(world->vehicle.state().T_world_body()) <= 0.0) {
    return fail(ErrorCode::kUsage, "fly", "the vehicle would start inside something",
                "choose another start, or a smaller body");
  }
  if (world->truth.distance_m(start.position_m, options.start_clear_m) < options.start_clear_m) {
    return fail(ErrorCode::kUsage, "fly",
                fmt::format("something is nearer to the start than {} m", options.start_clear_m),
                "choose a start with more room around it");
  }
  // Room for the body, its margin and the comfort, and what centres of voxels cannot tell.
  const double reach_m = options.body_radius_m + options.margin_m + options.comfort_m +
                         2.0 * map->window().voxel_m() + 0.2;
  auto view = PlannerView::create(map->window(), options.mapper.occupancy, reach_m);
  if (!view) return forward_error(std::move(view));
  const ViewCamera camera = camera_of(scene, world->rig.intrinsics());
  return ClosedLoop(std::move(*world), std::move(map), std::move(*view), *body, camera, start,
                    options)
      .run();
}

Expected<FlightReport> fly(const sim::Scene& scene, const FlightStart& start,
                           const FlyOptions& options) {
  auto map = make_swiftlet_map(options.mapper);
  if (!map) return forward_error(std::move(map));
  return fly(scene, start, options, std::move(*map));
}

}  // namespace swiftlet
