// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "swiftlet/base/time.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/frame/pose_sample.hpp"
#include "swiftlet/mavlink/wire/motion_messages.hpp"
#include "swiftlet/mavlink/wire/packet.hpp"

namespace swiftlet::mavlink {

/// Who takes the poses that an autopilot tells. Called by the links' thread; must not wait.
class PoseTaker {
 public:
  virtual ~PoseTaker() = default;
  virtual void take(const PoseSample& pose) = 0;
  /// The autopilot has reset its estimate: the next pose is of another world.
  virtual void start_anew() = 0;
};

/// The moment "now" on the clocks that a pose is told by.
struct PoseClocks {
  HostTime now{};
  Stamp unix_now{};
  std::optional<Nanoseconds> offset{};  ///< ours (HostTime) minus the vehicle's
};

/// Makes poses of what an autopilot tells: of ODOMETRY, or, as long as none comes, of
/// LOCAL_POSITION_NED with the attitude (ATTITUDE_QUATERNION) interpolated at its time. Positions
/// wait for an attitude at or after their time; they are never extrapolated.
///
/// World: x north (or ahead at the start), y west, z up. Stamps are Unix times of this computer, as
/// those of RealSense cameras with Global Time; before the clocks are known against each other
/// there are no poses. Confidence: 3 for high, or as ODOMETRY's quality says.
class VehiclePoses {
 public:
  explicit VehiclePoses(PoseTaker* taker) : taker_(taker) {}

  void hear(const Packet& packet, const PoseClocks& clocks);
  /// Whether any pose has come within the last second.
  [[nodiscard]] bool is_fed(HostTime now) const;
  [[nodiscard]] std::size_t given() const { return given_; }
  [[nodiscard]] std::size_t unsynchronised() const { return unsynchronised_; }

 private:
  struct Attitude {
    Nanoseconds time;  // of the vehicle's clock, since it started
    Eigen::Quaterniond R_ned_frd;
  };
  void hear_odometry(const Odometry& message, const PoseClocks& clocks);
  void hear_attitude(const AttitudeQuaternion& message, const PoseClocks& clocks);
  void give_position(const PoseClocks& clocks);
  void give(Nanoseconds time, const Eigen::Quaterniond& R_ned_frd, const Eigen::Vector3d& p_ned,
            std::uint8_t confidence, const PoseClocks& clocks);

  PoseTaker* taker_;
  std::optional<Attitude> before_, after_;  // the two newest attitudes
  std::optional<LocalPositionNed> waiting_;
  std::optional<std::uint8_t> resets_;  // ODOMETRY's reset_counter
  std::optional<HostTime> odometry_at_, given_at_;
  std::size_t given_ = 0, unsynchronised_ = 0;
};

}  // namespace swiftlet::mavlink
