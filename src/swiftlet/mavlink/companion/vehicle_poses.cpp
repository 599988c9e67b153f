// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/vehicle_poses.hpp"

#include <utility>

#include "swiftlet/mavlink/companion/frd_axes.hpp"
#include "swiftlet/mavlink/wire/codes.hpp"

namespace swiftlet::mavlink {
namespace {

constexpr Nanoseconds kSilence = std::chrono::seconds(1);
/// Between two attitudes that lie further apart nothing is interpolated.
constexpr Nanoseconds kLongestBridge = std::chrono::milliseconds(200);

Nanoseconds since_start(std::uint32_t time_boot_ms) {
  return std::chrono::milliseconds(time_boot_ms);
}

std::uint8_t confidence_of(std::int8_t quality) {
  if (quality < 0) return 0;
  if (quality == 0 || quality > 66) return 3;  // 0: it does not say
  return quality > 33 ? 2 : 1;
}

}  // namespace

void VehiclePoses::hear(const Packet& packet, const PoseClocks& clocks) {
  if (taker_ == nullptr) return;
  if (const auto odometry = packet.as<Odometry>()) return hear_odometry(*odometry, clocks);
  if (odometry_at_ && clocks.now - *odometry_at_ < kSilence) return;
  if (const auto attitude = packet.as<AttitudeQuaternion>()) hear_attitude(*attitude, clocks);
  if (const auto position = packet.as<LocalPositionNed>()) {
    waiting_ = position;
    give_position(clocks);
  }
}

void VehiclePoses::hear_odometry(const Odometry& message, const PoseClocks& clocks) {
  const bool is_level =
      message.frame_id == codes::kFrameLocalNed || message.frame_id == codes::kFrameLocalFrd;
  if (!is_level) return;
  odometry_at_ = clocks.now;
  if (resets_ && *resets_ != message.reset_counter) taker_->start_anew();
  resets_ = message.reset_counter;
  give(std::chrono::microseconds(message.time_usec),
       Eigen::Quaternionf(message.q[0], message.q[1], message.q[2], message.q[3]).cast<double>(),
       Eigen::Vector3f(message.x, message.y, message.z).cast<double>(),
       confidence_of(message.quality), clocks);
}

void VehiclePoses::hear_attitude(const AttitudeQuaternion& message, const PoseClocks& clocks) {
  const Eigen::Quaternionf q(message.q1, message.q2, message.q3, message.q4);
  before_ = std::exchange(after_, Attitude{since_start(message.time_boot_ms), q.cast<double>()});
  give_position(clocks);
}

void VehiclePoses::give_position(const PoseClocks& clocks) {
  if (!waiting_ || !before_ || !after_) return;
  const Nanoseconds time = since_start(waiting_->time_boot_ms);
  if (time > after_->time) return;  // its attitude has not come yet
  const auto position = std::exchange(waiting_, std::nullopt);
  const Nanoseconds bridge = after_->time - before_->time;
  if (time < before_->time || bridge <= Nanoseconds(0) || bridge > kLongestBridge) return;
  const double share = seconds(time - before_->time) / seconds(bridge);
  constexpr std::uint8_t kHigh = 3;
  give(time, before_->R_ned_frd.slerp(share, after_->R_ned_frd),
       Eigen::Vector3f(position->x, position->y, position->z).cast<double>(), kHigh, clocks);
}

void VehiclePoses::give(Nanoseconds time, const Eigen::Quaterniond& R_ned_frd,
                        const Eigen::Vector3d& p_ned, std::uint8_t confidence,
                        const PoseClocks& clocks) {
  if (!clocks.offset) {
    ++unsynchronised_;
    return;
  }
  const HostTime at{std::chrono::duration_cast<HostTime::duration>(time + *clocks.offset)};
  PoseSample pose;
  pose.stamp = clocks.unix_now - Nanoseconds(clocks.now - at);
  pose.R_world_body = turned_about_x(R_ned_frd);
  pose.t_world_body_m = turned_about_x(p_ned);
  pose.confidence = confidence;
  pose.clock = ClockDomain::kGlobal;
  ++given_;
  given_at_ = clocks.now;
  taker_->take(pose);
}

bool VehiclePoses::is_fed(HostTime now) const { return given_at_ && now - *given_at_ < kSilence; }

}  // namespace swiftlet::mavlink
