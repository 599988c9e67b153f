// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "swiftlet/mavlink/wire/message_layout.hpp"

// What is in the way. Source of names, numbers and order: the public dialects common.xml and, for
// the last one, ardupilotmega.xml.

namespace swiftlet::mavlink {

/// The distance to what is nearest in each of 72 sectors around the vehicle.
struct ObstacleDistance {
  static constexpr std::string_view kName = "OBSTACLE_DISTANCE";
  static constexpr std::uint32_t kId = 330;
  std::uint64_t time_usec = 0;
  std::array<std::uint16_t, 72> distances{};  ///< [cm]; max_distance + 1: nothing; 65535: not known
  std::uint16_t min_distance = 0;             ///< [cm]
  std::uint16_t max_distance = 0;             ///< [cm]
  std::uint8_t sensor_type = 0;               ///< MAV_DISTANCE_SENSOR
  std::uint8_t increment = 0;                 ///< between two sectors, clockwise [deg]
  float increment_f = 0;                      ///< if not 0, instead of increment [deg]
  float angle_offset = 0;                     ///< of sector 0 against the front [deg]
  std::uint8_t frame = 0;                     ///< MAV_FRAME
  [[nodiscard]] static constexpr auto fields() {
    using M = ObstacleDistance;
    return std::tuple(base("time_usec", &M::time_usec), base("distances", &M::distances),
                      base("min_distance", &M::min_distance),
                      base("max_distance", &M::max_distance), base("sensor_type", &M::sensor_type),
                      base("increment", &M::increment), extension("increment_f", &M::increment_f),
                      extension("angle_offset", &M::angle_offset), extension("frame", &M::frame));
  }
};

/// One obstacle; all of a scan have the same time_boot_ms.
struct ObstacleDistance3d {
  static constexpr std::string_view kName = "OBSTACLE_DISTANCE_3D";
  static constexpr std::uint32_t kId = 11037;
  std::uint32_t time_boot_ms = 0;
  float x = 0, y = 0, z = 0;                 ///< [m]
  float min_distance = 0, max_distance = 0;  ///< [m]
  std::uint16_t obstacle_id = 0;             ///< 65535: not known
  std::uint8_t sensor_type = 0;              ///< MAV_DISTANCE_SENSOR
  std::uint8_t frame = 0;                    ///< MAV_FRAME
  [[nodiscard]] static constexpr auto fields() {
    using M = ObstacleDistance3d;
    return std::tuple(base("time_boot_ms", &M::time_boot_ms), base("x", &M::x), base("y", &M::y),
                      base("z", &M::z), base("min_distance", &M::min_distance),
                      base("max_distance", &M::max_distance), base("obstacle_id", &M::obstacle_id),
                      base("sensor_type", &M::sensor_type), base("frame", &M::frame));
  }
};

/// One range finder's reading.
struct DistanceSensor {
  static constexpr std::string_view kName = "DISTANCE_SENSOR";
  static constexpr std::uint32_t kId = 132;
  std::uint32_t time_boot_ms = 0;
  std::uint16_t min_distance = 0, max_distance = 0, current_distance = 0;  ///< [cm]
  std::uint8_t type = 0;                                                   ///< MAV_DISTANCE_SENSOR
  std::uint8_t id = 0;                                                     ///< of the sensor
  std::uint8_t orientation = 0;                ///< MAV_SENSOR_ORIENTATION
  std::uint8_t covariance = 0;                 ///< [cm^2]; 255: not known
  float horizontal_fov = 0, vertical_fov = 0;  ///< [rad]
  std::array<float, 4> quaternion{};
  std::uint8_t signal_quality = 0;
  [[nodiscard]] static constexpr auto fields() {
    using M = DistanceSensor;
    return std::tuple(
        base("time_boot_ms", &M::time_boot_ms), base("min_distance", &M::min_distance),
        base("max_distance", &M::max_distance), base("current_distance", &M::current_distance),
        base("type", &M::type), base("id", &M::id), base("orientation", &M::orientation),
        base("covariance", &M::covariance), extension("horizontal_fov", &M::horizontal_fov),
        extension("vertical_fov", &M::vertical_fov), extension("quaternion", &M::quaternion),
        extension("signal_quality", &M::signal_quality));
  }
};

}  // namespace swiftlet::mavlink
