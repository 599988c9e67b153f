// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace swiftlet {

/// How a flight ended.
enum class FlightEnd : std::uint8_t {
  kArrived,    ///< at the goal
  kExplored,   ///< nothing is left to look at, and the vehicle is home again
  kCollided,   ///< the body touched something of the true scene
  kStuck,      ///< there was nowhere left to go, short of the goal or of home
  kOutOfTime,  ///< the time limit
  kStopped,    ///< by the caller
  kMissed,     ///< it took itself to be there, and truly was more than half a metre off
};
inline constexpr std::array<std::string_view, 7> kFlightEndNames{
    "arrived", "explored", "collided", "stuck", "out_of_time", "stopped", "missed"};
[[nodiscard]] constexpr std::string_view name_of(FlightEnd end) {
  return kFlightEndNames[static_cast<std::size_t>(end)];
}

/// What became of a flight. Lengths and clearances are those of the truth, not of the map.
struct FlightReport {
  FlightEnd end = FlightEnd::kOutOfTime;
  double time_s = 0.0;  ///< simulated
  double length_m = 0.0;
  double mean_speed_mps = 0.0;  ///< over the whole time, looking around included
  double top_speed_mps = 0.0;
  double least_clearance_m = 0.0;  ///< from the body to the true scene, at least 100 times a second
  double goal_distance_m = 0.0;    ///< at the end, from the goal or from home
  double known_m3 = 0.0;           ///< free and occupied voxels of the map, what left it included
  /// Of the space in the last window that the body could truly reach; if exploring.
  double known_share = 0.0;
  double waiting_share = 0.0;  ///< of the time: standing still without a path to fly
  std::size_t plans = 0;
  std::size_t plans_failed = 0;
  std::size_t blocked = 0;  ///< times a new frame blocked the path being flown
  std::size_t frames = 0;
  std::size_t frames_refused = 0;  ///< by the mapper, or without a pose
  std::size_t frames_dropped = 0;  ///< that came while the map was busy, if its time is counted
  // Processor time of one thread, measured on this machine; everything above is the same on every
  // one.
  std::size_t deadline_misses = 0;  ///< frames whose map, field and frontier took over a period
  std::size_t late_plans = 0;       ///< plans that took longer than the flight allows for
  double frame_ms = 0.0;            ///< map, field and frontier, mean and longest
  double frame_ms_max = 0.0;
  double plan_ms = 0.0;
  double plan_ms_max = 0.0;
  /// Of where the vehicle was all the time: two flights with the same one are the same flight.
  std::uint64_t digest = 0;
  std::vector<Eigen::Vector3d> track{};  ///< ten places a second [m, scene]

  [[nodiscard]] bool is_success() const {
    return end == FlightEnd::kArrived || end == FlightEnd::kExplored;
  }
};

}  // namespace swiftlet
