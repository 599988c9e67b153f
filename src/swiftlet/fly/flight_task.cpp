// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/fly/flight_task.hpp"

#include <cmath>
#include <string>
#include <utility>

#include "swiftlet/source/sim/sim_flight.hpp"

namespace swiftlet {

namespace {

/// What the address of a recording may say and a flight has no use for, or flags of its own.
bool says_more_than_a_scene(const SimOptions& o) {
  return o.frames || o.rate_hz || o.cameras != 1 || o.shuffle || o.fault || o.rig_file ||
         !o.has_noise || !o.has_drift;
}

}  // namespace

Expected<FlightTask> read_flight_task(std::string_view address) {
  constexpr std::string_view kSim = "sim:";
  if (address.starts_with(kSim)) address.remove_prefix(kSim.size());
  auto flight = read_sim_flight(address);
  if (!flight) return forward_error(std::move(flight));
  if (says_more_than_a_scene(flight->options)) {
    return fail(ErrorCode::kUsage, std::string(address),
                "a flight takes the scene, where it starts and what random scenes are like",
                "leave the other options of the address out; flags of fly may stand for them");
  }
  FlightTask task;
  if (flight->task) {
    task.start = {flight->task->start_m, flight->task->start_yaw_rad};
    task.goal_m = flight->task->goal_m;
    task.bounds = SpaceBox{flight->task->bounds_m.min(), flight->task->bounds_m.max()};
  } else {
    const auto T = flight->scene.flight.camera_at(flight->options.start) *
                   flight->scene.T_body_camera.inverse();
    const Eigen::Vector3d ahead = T.rotation() * Eigen::Vector3d::UnitX();
    task.start = {T.translation(), std::atan2(ahead.y(), ahead.x())};
  }
  task.scene = std::move(flight->scene);
  return task;
}

}  // namespace swiftlet
