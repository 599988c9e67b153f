// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/frame/trusted_poses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace swiftlet {
namespace {

constexpr Nanoseconds kPathMemory = std::chrono::milliseconds(50);
constexpr std::size_t kMaxPath = 16;

double angle_of(const Eigen::Quaterniond& from, const Eigen::Quaterniond& to) {
  return from.angularDistance(to);
}

/// The turn about the vertical that a rotation contains.
double yaw_of(const Eigen::Quaterniond& R) {
  const Eigen::Matrix3d M = R.toRotationMatrix();
  return std::atan2(M(1, 0) - M(0, 1), M(0, 0) + M(1, 1));
}

}  // namespace

PoseGates PoseGates::open() {
  PoseGates gates;
  gates.max_speed_mps = std::numeric_limits<double>::infinity();
  return gates;
}

std::optional<Transform<World, Body>> TrustedPoses::checked(const PoseSample& sample) {
  if (!has_clock_) clock_ = sample.clock;  // even a sample that is not trusted tells it
  has_clock_ = true;
  if (sample.confidence < options_.gates.min_confidence) {
    refuse(PoseRefusal::kLowConfidence);
    return std::nullopt;
  }
  if (!sample.R_world_body.coeffs().allFinite() || !sample.t_world_body_m.allFinite()) {
    refuse(PoseRefusal::kNotFinite);
    return std::nullopt;
  }
  const auto T = Transform<World, Body>::from(sample.R_world_body, sample.t_world_body_m);
  if (!T) {
    refuse(PoseRefusal::kNotUnit);
    return std::nullopt;
  }
  if (sample.clock != clock_) {
    refuse(PoseRefusal::kClockMismatch);
    return std::nullopt;
  }
  return *T;
}

TrustedPoses::Pose TrustedPoses::anchored(const Pose& raw) const {
  return {raw.stamp, T_world_source_ * raw.T};
}

bool TrustedPoses::is_plausible_after(const std::deque<Pose>& path, const Pose& next) const {
  const PoseGates& gates = options_.gates;
  if (path.empty() || std::isinf(gates.max_speed_mps)) return true;
  const Pose& last = path.back();
  // Beyond max_gap a longer silence explains no longer way: the body is lost from sight by then.
  const double dt_s = seconds(std::min(next.stamp - last.stamp, options_.track.max_gap));
  const Eigen::Vector3d step_m = next.T.translation() - last.T.translation();
  if (step_m.norm() > gates.max_speed_mps * dt_s + gates.slack_m) return false;
  if (angle_of(last.T.rotation(), next.T.rotation()) >
      gates.max_turn_radps * dt_s + gates.slack_rad)
    return false;

  const double path_s = seconds(last.stamp - path.front().stamp);
  if (path_s <= 0.0 || next.stamp - last.stamp > options_.track.max_gap) return true;
  const Eigen::Vector3d v_mps = (last.T.translation() - path.front().T.translation()) / path_s;
  // The velocity is that of the middle of the path, so it is older than the step by half of it.
  const double bend_m = 0.5 * gates.max_acceleration_mps2 * dt_s * (dt_s + path_s);
  // Noise of both ends of the path grows with the lever.
  const double noise_m = gates.slack_m * (1.0 + 0.1 * dt_s / path_s);
  return (step_m - v_mps * dt_s).norm() <= bend_m + noise_m;
}

void TrustedPoses::accept(const Pose& pose) {
  const PoseIntake intake = track_.push(pose.stamp, pose.T.rotation(), pose.T.translation(), mark_);
  if (intake == PoseIntake::kDuplicateStamp) return refuse(PoseRefusal::kDuplicateStamp);
  if (intake == PoseIntake::kTooOld) return refuse(PoseRefusal::kTooOld);
  recent_.push_back(pose);
  while (recent_.size() > kMaxPath ||
         (recent_.size() > 2 && pose.stamp - recent_.front().stamp > kPathMemory)) {
    recent_.pop_front();
  }
}

/// Sorts a pose that was overtaken into its place, if it lies where the path went.
void TrustedPoses::push_late(const Pose& pose) {
  const bool is_trusting = std::isinf(options_.gates.max_speed_mps);
  if (const auto there = track_.find(pose.stamp); there && !is_trusting) {
    const double off_m = (there->T_world_body.translation() - pose.T.translation()).norm();
    const double off_rad = angle_of(there->T_world_body.rotation(), pose.T.rotation());
    if (off_m > 2.0 * options_.gates.slack_m || off_rad > 2.0 * options_.gates.slack_rad)
      return refuse(PoseRefusal::kOutlier);
  } else if (!there && !is_trusting) {
    return refuse(PoseRefusal::kTooOld);  // nothing to compare it with
  }
  const PoseIntake intake = track_.push(pose.stamp, pose.T.rotation(), pose.T.translation(), mark_);
  if (intake == PoseIntake::kDuplicateStamp) refuse(PoseRefusal::kDuplicateStamp);
  if (intake == PoseIntake::kTooOld) refuse(PoseRefusal::kTooOld);
}

/// Where the path leads to at the time of the first pose after the jump, against where that pose
/// is. The T265's world stays level when it corrects itself, so only the turn about the vertical
/// counts, and only if it is a turn and not noise.
Transform<World, World> TrustedPoses::anchor_after_jump() const {
  const Pose& last = recent_.back();
  const Pose& first = held_.front();
  const double path_s = seconds(last.stamp - recent_.front().stamp);
  const Eigen::Vector3d way_m = last.T.translation() - recent_.front().T.translation();
  const double lever = path_s > 0.0 ? seconds(first.stamp - last.stamp) / path_s : 0.0;
  const Eigen::Vector3d expected_m = last.T.translation() + lever * way_m;

  double yaw_rad = yaw_of(last.T.rotation() * first.T.rotation().conjugate());
  const double old_yaw_rad = yaw_of(T_world_source_.rotation());
  if (std::abs(std::remainder(yaw_rad - old_yaw_rad, 2.0 * M_PI)) < options_.gates.slack_rad)
    yaw_rad = old_yaw_rad;
  const Eigen::Quaterniond R(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()));
  return Transform<World, World>::trusted(R, expected_m - R * first.T.translation());
}

void TrustedPoses::jump() {
  const bool is_measurable = held_.front().stamp - recent_.back().stamp <= options_.track.max_gap;
  ++mark_.segment;
  if (options_.gates.on_jump == JumpPolicy::kKeep && is_measurable) {
    T_world_source_ = anchor_after_jump();
  } else {
    T_world_source_ = {};
    ++mark_.epoch;
  }
  recent_.clear();
  for (const Pose& raw : std::exchange(held_, {})) accept(anchored(raw));
}

void TrustedPoses::start_anew() {
  ++mark_.segment;
  ++mark_.epoch;
  T_world_source_ = {};
  recent_.clear();
  held_.clear();
}

void TrustedPoses::restart_clock(Stamp first) {
  ++mark_.segment;
  ++clock_restarts_;
  track_.clear();
  held_.clear();
  newest_.reset();
  if (recent_.empty()) return;
  // How long it took is not known: as after a silence that is too long to measure a jump in.
  Pose last = recent_.back();
  last.stamp = first - options_.track.max_gap - Nanoseconds(1);
  recent_.clear();
  recent_.push_back(last);
}

void TrustedPoses::hold(const Pose& raw) {
  if (!held_.empty() && !is_plausible_after(held_, raw)) {
    refuse(PoseRefusal::kOutlier, held_.size());
    held_.clear();
  }
  held_.push_back(raw);
  if (held_.size() >= std::max<std::size_t>(options_.gates.confirm, 1)) jump();
}

void TrustedPoses::push(const PoseSample& sample) {
  const auto T = checked(sample);
  if (!T) return;
  newest_ = newest_ ? std::max(*newest_, sample.stamp) : sample.stamp;

  const Pose raw{sample.stamp, *T};
  const Pose pose = anchored(raw);
  if (!recent_.empty() && pose.stamp <= recent_.back().stamp) return push_late(pose);
  if (!held_.empty() && raw.stamp <= held_.back().stamp) return refuse(PoseRefusal::kOutlier);
  if (!is_plausible_after(recent_, pose)) return hold(raw);
  refuse(PoseRefusal::kOutlier, held_.size());
  held_.clear();
  accept(pose);
}

}  // namespace swiftlet
