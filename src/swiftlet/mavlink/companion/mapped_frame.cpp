// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/mavlink/companion/mapped_frame.hpp"

namespace swiftlet::mavlink {
namespace {

bool is_turned(const Eigen::Quaterniond& R) { return R.vec().squaredNorm() > 1e-12; }

HostTime taken_at(const Frame& frame, HostTime now, Stamp unix_now) {
  const Nanoseconds age = unix_now - frame.stamp;
  if (age >= Nanoseconds(0) && age < std::chrono::seconds(1)) return now - age;
  return frame.seen_at.value_or(now);
}

}  // namespace

MappedFrame mapped_frame(const Frame& frame, const Transform<Body, Camera>& T_body_camera,
                         HostTime now, Stamp unix_now) {
  const auto mount = is_turned(T_body_camera.rotation()) ? T_body_camera : forward_looking_camera();
  MappedFrame mapped;
  mapped.T_world_body = frame.T_world_camera * mount.inverse();
  mapped.taken_at = taken_at(frame, now, unix_now);
  mapped.mapped_at = now;
  mapped.pose_epoch = frame.pose_epoch;
  return mapped;
}

}  // namespace swiftlet::mavlink
