// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "swiftlet/mavlink/wire/message_layout.hpp"

// Where a vehicle is and how it moves. Axes of the world: x north (or ahead at the start), y to the
// right of it, z down (NED, FRD); of the body: x forward, y right, z down. Quaternions are w, x, y,
// z. Source of names, numbers and order: the public dialect common.xml.

namespace swiftlet::mavlink {

struct AttitudeQuaternion {
  static constexpr std::string_view kName = "ATTITUDE_QUATERNION";
  static constexpr std::uint32_t kId = 31;
  std::uint32_t time_boot_ms = 0;
  float q1 = 1, q2 = 0, q3 = 0, q4 = 0;               ///< R_ned_frd as w, x, y, z
  float rollspeed = 0, pitchspeed = 0, yawspeed = 0;  ///< [rad/s]
  std::array<float, 4> repr_offset_q{};
  [[nodiscard]] static constexpr auto fields() {
    using M = AttitudeQuaternion;
    return std::tuple(base("time_boot_ms", &M::time_boot_ms), base("q1", &M::q1),
                      base("q2", &M::q2), base("q3", &M::q3), base("q4", &M::q4),
                      base("rollspeed", &M::rollspeed), base("pitchspeed", &M::pitchspeed),
                      base("yawspeed", &M::yawspeed),
                      extension("repr_offset_q", &M::repr_offset_q));
  }
};

struct LocalPositionNed {
  static constexpr std::string_view kName = "LOCAL_POSITION_NED";
  static constexpr std::uint32_t kId = 32;
  std::uint32_t time_boot_ms = 0;
  float x = 0, y = 0, z = 0;     ///< [m]
  float vx = 0, vy = 0, vz = 0;  ///< [m/s]
  [[nodiscard]] static constexpr auto fields() {
    using M = LocalPositionNed;
    return std::tuple(base("time_boot_ms", &M::time_boot_ms), base("x", &M::x), base("y", &M::y),
                      base("z", &M::z), base("vx", &M::vx), base("vy", &M::vy), base("vz", &M::vz));
  }
};

/// Upper triangles of 6 x 6 covariances, row by row, of x, y, z, roll, pitch, yaw; NaN first if not
/// known.
using Covariance6 = std::array<float, 21>;

/// A pose and its speed, from whoever estimates them.
struct Odometry {
  static constexpr std::string_view kName = "ODOMETRY";
  static constexpr std::uint32_t kId = 331;
  std::uint64_t time_usec = 0;
  float x = 0, y = 0, z = 0;                          ///< in frame_id [m]
  std::array<float, 4> q{1, 0, 0, 0};                 ///< R_frame_child
  float vx = 0, vy = 0, vz = 0;                       ///< in child_frame_id [m/s]
  float rollspeed = 0, pitchspeed = 0, yawspeed = 0;  ///< [rad/s]
  Covariance6 pose_covariance{};
  Covariance6 velocity_covariance{};
  std::uint8_t frame_id = 0;        ///< MAV_FRAME
  std::uint8_t child_frame_id = 0;  ///< MAV_FRAME
  std::uint8_t reset_counter = 0;   ///< one more whenever the pose jumps
  std::uint8_t estimator_type = 0;  ///< MAV_ESTIMATOR_TYPE
  std::int8_t quality = 0;          ///< -1 failed, 0 not known, 1 to 100 %
  [[nodiscard]] static constexpr auto fields() {
    using M = Odometry;
    return std::tuple(
        base("time_usec", &M::time_usec), base("x", &M::x), base("y", &M::y), base("z", &M::z),
        base("q", &M::q), base("vx", &M::vx), base("vy", &M::vy), base("vz", &M::vz),
        base("rollspeed", &M::rollspeed), base("pitchspeed", &M::pitchspeed),
        base("yawspeed", &M::yawspeed), base("pose_covariance", &M::pose_covariance),
        base("velocity_covariance", &M::velocity_covariance), base("frame_id", &M::frame_id),
        base("child_frame_id", &M::child_frame_id), extension("reset_counter", &M::reset_counter),
        extension("estimator_type", &M::estimator_type), extension("quality", &M::quality));
  }
};

/// The older way to tell a pose: without speed or quality.
struct VisionPositionEstimate {
  static constexpr std::string_view kName = "VISION_POSITION_ESTIMATE";
  static constexpr std::uint32_t kId = 102;
  std::uint64_t usec = 0;
  float x = 0, y = 0, z = 0;           ///< [m]
  float roll = 0, pitch = 0, yaw = 0;  ///< [rad]
  Covariance6 covariance{};
  std::uint8_t reset_counter = 0;
  [[nodiscard]] static constexpr auto fields() {
    using M = VisionPositionEstimate;
    return std::tuple(base("usec", &M::usec), base("x", &M::x), base("y", &M::y), base("z", &M::z),
                      base("roll", &M::roll), base("pitch", &M::pitch), base("yaw", &M::yaw),
                      extension("covariance", &M::covariance),
                      extension("reset_counter", &M::reset_counter));
  }
};

struct VisionSpeedEstimate {
  static constexpr std::string_view kName = "VISION_SPEED_ESTIMATE";
  static constexpr std::uint32_t kId = 103;
  std::uint64_t usec = 0;
  float x = 0, y = 0, z = 0;  ///< [m/s]
  std::array<float, 9> covariance{};
  std::uint8_t reset_counter = 0;
  [[nodiscard]] static constexpr auto fields() {
    using M = VisionSpeedEstimate;
    return std::tuple(base("usec", &M::usec), base("x", &M::x), base("y", &M::y), base("z", &M::z),
                      extension("covariance", &M::covariance),
                      extension("reset_counter", &M::reset_counter));
  }
};

struct HighresImu {
  static constexpr std::string_view kName = "HIGHRES_IMU";
  static constexpr std::uint32_t kId = 105;
  std::uint64_t time_usec = 0;
  float xacc = 0, yacc = 0, zacc = 0;     ///< [m/s^2]
  float xgyro = 0, ygyro = 0, zgyro = 0;  ///< [rad/s]
  float xmag = 0, ymag = 0, zmag = 0;     ///< [gauss]
  float abs_pressure = 0, diff_pressure = 0, pressure_alt = 0;
  float temperature = 0;
  std::uint16_t fields_updated = 0;
  std::uint8_t id = 0;
  [[nodiscard]] static constexpr auto fields() {
    using M = HighresImu;
    return std::tuple(base("time_usec", &M::time_usec), base("xacc", &M::xacc),
                      base("yacc", &M::yacc), base("zacc", &M::zacc), base("xgyro", &M::xgyro),
                      base("ygyro", &M::ygyro), base("zgyro", &M::zgyro), base("xmag", &M::xmag),
                      base("ymag", &M::ymag), base("zmag", &M::zmag),
                      base("abs_pressure", &M::abs_pressure),
                      base("diff_pressure", &M::diff_pressure),
                      base("pressure_alt", &M::pressure_alt), base("temperature", &M::temperature),
                      base("fields_updated", &M::fields_updated), extension("id", &M::id));
  }
};

}  // namespace swiftlet::mavlink
