// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/tracker/tracker_model.hpp"

#include <cmath>
#include <limits>

#include "swiftlet/base/voxel_index.hpp"

namespace swiftlet::sim {
namespace {

/// Position and heading of a pose, without its tilt.
Transform<World, World> levelled(const Transform<World, Body>& T) {
  const Eigen::Vector3d forward = T.rotation() * Eigen::Vector3d::UnitX();
  return Transform<World, World>::trusted(
      rotation_from_ypr(std::atan2(forward.y(), forward.x()), 0.0, 0.0), T.translation());
}

// Our axes named in the device's: its x is our -y, its y our z, its z our -x.
Eigen::Vector3d in_device_axes(const Eigen::Vector3d& v) { return {-v.y(), v.z(), -v.x()}; }
Eigen::Quaterniond in_device_axes(const Eigen::Quaterniond& q) {
  return {q.w(), -q.y(), q.z(), -q.x()};
}

}  // namespace

TrackerModel::TrackerModel(const TrackerOptions& options, std::uint64_t seed,
                           const Transform<World, Body>& start)
    : options_(options), T_scene_tracker_(levelled(start)), random_(mix_bits(seed ^ 0x7265)) {}

TrackerDrift TrackerModel::drift() const {
  return {T_scene_tracker_.rotation() * drift_m_, yaw_drift_rad_};
}

Stamp TrackerModel::next_stamp() const {
  return Stamp{std::llround(static_cast<double>(samples_) * 1e9 / options_.rate_hz)};
}

Eigen::Vector3d TrackerModel::noise(double sigma) {
  const double x = gaussian_(random_);
  const double y = gaussian_(random_);
  return sigma * Eigen::Vector3d(x, y, gaussian_(random_));
}

void TrackerModel::wander(double dt_s) {
  const double root_dt = std::sqrt(dt_s);
  drift_m_ += noise(options_.drift_m_per_sqrt_s * root_dt);
  yaw_drift_rad_ += options_.yaw_drift_rad_per_sqrt_s * root_dt * gaussian_(random_);
  const double t_s = static_cast<double>(samples_) / options_.rate_hz;
  if (options_.jump && !has_jumped_ && t_s >= options_.jump->at_s) {
    drift_m_ += options_.jump->by_m;
    yaw_drift_rad_ += options_.jump->yaw_rad;
    has_jumped_ = true;
  }
}

std::uint8_t TrackerModel::confidence(double t_s) const {
  if (t_s >= options_.high_after_s) return 3;
  return t_s >= options_.medium_after_s ? 2 : 1;
}

RawTrackerPose TrackerModel::sample(const Transform<World, Body>& T_scene_body) {
  const Stamp stamp = next_stamp();
  if (samples_ > 0) wander(1.0 / options_.rate_hz);
  ++samples_;

  const auto T_tracker_body = T_scene_tracker_.inverse() * T_scene_body;
  const Eigen::Vector3d tilt = noise(options_.attitude_noise_rad);
  const Eigen::Quaterniond R = rotation_from_ypr(yaw_drift_rad_, 0.0, 0.0) *
                               T_tracker_body.rotation() *
                               rotation_from_ypr(tilt.z(), tilt.y(), tilt.x());
  const Eigen::Vector3d t_m =
      T_tracker_body.translation() + drift_m_ + noise(options_.position_noise_m);

  RawTrackerPose pose{stamp, in_device_axes(R.normalized()), in_device_axes(t_m),
                      confidence(seconds(Nanoseconds(stamp.ns)))};
  if (std::uniform_real_distribution<double>()(random_) < options_.nan_chance) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    pose.R_raw.coeffs().setConstant(kNan);
    pose.t_raw_m.setConstant(kNan);
  }
  return pose;
}

}  // namespace swiftlet::sim
