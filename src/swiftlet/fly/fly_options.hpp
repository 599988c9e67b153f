// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>

#include "swiftlet/base/time.hpp"
#include "swiftlet/pipeline/mapper_config.hpp"
#include "swiftlet/plan/course.hpp"
#include "swiftlet/plan/plan_options.hpp"
#include "swiftlet/sim/vehicle/vehicle_model.hpp"

namespace swiftlet {

/// The mapper's defaults in voxels of 10 cm, which a vehicle of 40 cm needs to pass a door; and as
/// far as the camera sees, since a wall at 15 m clears the 10 m before it.
[[nodiscard]] inline MapperConfig flown_config() {
  MapperConfig config;
  config.depth.max_range_m = 16.0;
  config.map.voxel_m = 0.1;
  return config;
}

/// A flight on nothing but a map.
struct FlyOptions {
  std::optional<Eigen::Vector3d> goal_m{};  ///< none: explore until nothing is left, then home
  std::optional<SpaceBox> bounds{};         ///< where the vehicle may be
  std::uint64_t seed = 1;                   ///< of the instruments' noise, the wind and the planner
  double max_speed_mps = 2.0;
  double body_radius_m = 0.2;  ///< of the ball that holds the vehicle
  double margin_m = 0.1;       ///< kept from all that is not free, beyond the body
  double comfort_m = 0.3;      ///< and so much more where it costs little
  /// Who puts the vehicle down has seen to so much room around it. At half a metre from a camera
  /// that sees 58 degrees high there is not yet room for body and margin: less would be too little
  /// to fly out of.
  double start_clear_m = 0.9;
  double max_acceleration_mps2 = 3.0;  ///< that a path may ask for, each along it and across
  double time_limit_s = 300.0;
  double rate_hz = 15.0;  ///< of depth images
  bool has_noise = true;
  Nanoseconds map_latency{50'000'000};  ///< from a frame until the planner sees the map with it
  /// Count what the map took on this machine instead, and drop the frames that come meanwhile: for
  /// maps too slow for the above. Then flights do not repeat to the bit.
  bool counts_measured_time = false;
  Nanoseconds plan_latency{100'000'000};  ///< from a question to the planner until its answer
  MapperConfig mapper = flown_config();
  sim::VehicleOptions vehicle{};
  std::function<bool()> is_unwanted{};  ///< asked now and then; true ends the flight
  /// Told after each frame that the planner sees. A flight is the same whether it is told or not.
  std::function<void(const Course&)> on_course{};
  bool is_paced = false;  ///< no faster than the clock on the wall, for who looks on
};

}  // namespace swiftlet
