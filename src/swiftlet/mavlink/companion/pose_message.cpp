// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/pose_message.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "swiftlet/mavlink/companion/frd_axes.hpp"
#include "swiftlet/mavlink/wire/codes.hpp"

namespace swiftlet::mavlink {
namespace {

constexpr std::array<std::int8_t, 4> kQuality{-1, 33, 66, 100};
constexpr std::array<float, 4> kVariance{10, 1, 0.1F, 0.01F};
constexpr float kMotionFactor = 10;

std::size_t confidence_of(const MappedFrame& frame) {
  return std::min<std::size_t>(frame.confidence, kQuality.size() - 1);
}

/// The diagonal of a 6 x 6 matrix whose upper triangle is stored row by row.
Covariance6 diagonal(float variance) {
  Covariance6 all{};
  for (const std::size_t i : {0, 6, 11, 15, 18, 20}) all[i] = variance;
  return all;
}

}  // namespace

BodyMotion motion_between(const MappedFrame& frame, const MappedFrame& next) {
  const double dt_s = seconds(Nanoseconds(next.taken_at - frame.taken_at));
  const Eigen::Quaterniond R_body_world = next.T_world_body.rotation().conjugate();
  const Eigen::Vector3d step_m = next.T_world_body.translation() - frame.T_world_body.translation();
  const Eigen::AngleAxisd turn(frame.T_world_body.rotation().conjugate() *
                               next.T_world_body.rotation());
  return {R_body_world * step_m / dt_s, turn.axis() * turn.angle() / dt_s};
}

Odometry odometry_of(const MappedFrame& frame, const BodyMotion& motion, std::uint64_t time_usec,
                     std::uint8_t reset_counter) {
  const Eigen::Vector3f p = turned_about_x(frame.T_world_body.translation()).cast<float>();
  const Eigen::Quaternionf q = turned_about_x(frame.T_world_body.rotation()).cast<float>();
  const Eigen::Vector3f v = turned_about_x(motion.v_body_mps).cast<float>();
  const Eigen::Vector3f w = turned_about_x(motion.w_body_radps).cast<float>();
  const float variance = kVariance[confidence_of(frame)];
  Odometry message;
  message.time_usec = time_usec;
  message.x = p.x();
  message.y = p.y();
  message.z = p.z();
  message.q = {q.w(), q.x(), q.y(), q.z()};
  message.vx = v.x();
  message.vy = v.y();
  message.vz = v.z();
  message.rollspeed = w.x();
  message.pitchspeed = w.y();
  message.yawspeed = w.z();
  message.pose_covariance = diagonal(variance);
  message.velocity_covariance = diagonal(kMotionFactor * variance);
  message.frame_id = codes::kFrameLocalFrd;
  message.child_frame_id = codes::kFrameBodyFrd;
  message.reset_counter = reset_counter;
  message.estimator_type = codes::kEstimatorVio;
  message.quality = kQuality[confidence_of(frame)];
  return message;
}

VisionPositionEstimate vision_position_of(const MappedFrame& frame, std::uint64_t time_usec,
                                          std::uint8_t reset_counter) {
  const Eigen::Vector3f p = turned_about_x(frame.T_world_body.translation()).cast<float>();
  const Eigen::Matrix3d R = turned_about_x(frame.T_world_body.rotation()).toRotationMatrix();
  VisionPositionEstimate message;
  message.usec = time_usec;
  message.x = p.x();
  message.y = p.y();
  message.z = p.z();
  message.roll = static_cast<float>(std::atan2(R(2, 1), R(2, 2)));
  message.pitch = static_cast<float>(-std::asin(std::clamp(R(2, 0), -1.0, 1.0)));
  message.yaw = static_cast<float>(std::atan2(R(1, 0), R(0, 0)));
  message.covariance = diagonal(kVariance[confidence_of(frame)]);
  message.reset_counter = reset_counter;
  return message;
}

}  // namespace swiftlet::mavlink
