// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

// What the vehicle decides on board: where to, along which path, and when to look.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "swiftlet/fly/closed_loop_private.hpp"
#include "swiftlet/plan/motion_check.hpp"
#include "swiftlet/plan/path_smoothing.hpp"
#include "swiftlet/plan/plan_path.hpp"

namespace swiftlet {
namespace {

constexpr Nanoseconds kThink{300'000'000};
constexpr Nanoseconds kWarmUp_ns{1'000'000'000};
constexpr Nanoseconds kLook{400'000'000};  // six frames at a view
constexpr double kSameTarget_m = 1.2;

}  // namespace

void ClosedLoop::decide() {
  take_pending();
  switch (phase_) {
    case Phase::kWarmUp:
      if (now_ - Stamp{} >= kWarmUp_ns && view_.has_map()) phase_ = Phase::kTurn;
      return;
    case Phase::kTurn:
      turn();
      return;
    case Phase::kLook:
      if (now_ >= looking_until_) arrive();
      return;
    case Phase::kFly:
      break;
  }
  const bool is_there = follower_.left_m() < 0.01 && !pending_ && target_ && !is_blocked_;
  if (is_there && (follower_.place_m() - target_->p_world).norm() < 0.1) {
    const double left_rad =
        target_->yaw_rad ? std::remainder(*target_->yaw_rad - yaw_rad_, 2 * std::numbers::pi) : 0.0;
    if (std::abs(left_rad) > 0.05) return;  // still turning to what it came to see
    phase_ = Phase::kLook;
    looking_until_ = now_ + kLook;
    return;
  }
  if (now_ >= next_thought_) think();
}

/// Once around, in place.
void ClosedLoop::turn() {
  if (turned_rad_ < 2.0 * std::numbers::pi) return;
  turned_rad_ = 0.0;
  has_turned_since_ = true;
  phase_ = Phase::kFly;
}

/// It has come to its target and looked.
void ClosedLoop::arrive() {
  phase_ = Phase::kFly;
  next_thought_ = now_;
  if (target_->is_goal) {
    end(is_going_home_ ? FlightEnd::kExplored : FlightEnd::kArrived);
  } else if (has_looked_in_vain(target_->looks_at_m)) {
    choice_.give_up(*target_);
  }
  target_.reset();
}

/// Whether the frontier is still where the vehicle has just looked, or it looked there before.
bool ClosedLoop::has_looked_in_vain(const Eigen::Vector3d& p) {
  constexpr double kSamePlace_m = 0.5;
  constexpr std::ptrdiff_t kOften = 3;
  looked_at_.push_back(p);
  const auto times = std::ranges::count_if(looked_at_, [&](const Eigen::Vector3d& before) {
    return (before - p).norm() < kSamePlace_m;
  });
  return times >= kOften || frontier_near(p).size() >= TargetChoice::kFewVoxels;
}

/// Whether the camera has been turned to a place for so long that what is a frontier there stays
/// one, as on the floor where rays end on the border of two voxels. Counts this look, too.
bool ClosedLoop::has_been_in_view(const Eigen::Vector3d& p) {
  constexpr double kSamePlace_m = 0.5, kNear_m = 3.0;
  constexpr std::ptrdiff_t kLong = 6;  // thoughts: two seconds
  if ((p - follower_.place_m()).norm() > kNear_m) return false;
  const auto T_world_camera = level_pose(follower_.place_m(), yaw_rad_) * camera_.T_body_camera;
  if (voxels_in_sight(view_.map(), frontier_near(p), T_world_camera, camera_, policy_.thresholds) ==
      0)
    return false;
  seen_.push_back(p);
  return std::ranges::count_if(seen_, [&](const Eigen::Vector3d& before) {
           return (before - p).norm() < kSamePlace_m;
         }) >= kLong;
}

std::vector<VoxelIndex> ClosedLoop::frontier_near(const Eigen::Vector3d& p) const {
  constexpr double kNear_m = 0.5;
  std::vector<VoxelIndex> voxels;
  view_.frontier().for_each_voxel([&](const VoxelIndex& v) {
    if ((centre_of(v, view_.map().voxel_m()) - p).norm() < kNear_m) voxels.push_back(v);
  });
  return voxels;
}

bool ClosedLoop::is_path_good_for(const FlightTarget& target, const Eigen::Vector3d& from) const {
  if (!target_ || is_blocked_ || target.is_goal != target_->is_goal) return false;
  if (flown_policy_.margin_m < policy_.margin_m) {  // it began in a tight place: is there room now?
    const auto policy = policy_from(from);
    if (policy && policy->margin_m > flown_policy_.margin_m) return false;
  }
  if (target.is_goal) return (target.p_world - target_->p_world).norm() < 0.05;
  const bool is_same = (target.looks_at_m - target_->looks_at_m).norm() < kSameTarget_m;
  return is_same && follower_.left_m() > 0.3;
}

/// The path is flown on to here, at the latest, before the planner answers.
double ClosedLoop::locked_m() const {
  const double delay_s = seconds(options_.plan_latency) + 0.02;
  return follower_.path_m() +
         delay_s * (follower_.speed_mps() + 0.5 * options_.max_acceleration_mps2 * delay_s);
}

void ClosedLoop::think() {
  if (!view_.has_map() || pending_) return;
  const ThreadTime time;
  next_thought_ = now_ + kThink;
  // From where the vehicle can still stop when the answer comes.
  const double commit_m = std::min(follower_.end_m(), locked_m() + 2.0 * follower_.stopping_m());
  const Eigen::Vector3d from = follower_.place_at(commit_m);
  const double needed_m =
      room_for_ball_m(options_.body_radius_m + options_.margin_m, view_.map().voxel_m());
  space_.flood(view_.field(), Obstacles::kNotFree, from, needed_m);
  std::optional<FlightTarget> target;
  if (is_going_home_) {
    target = FlightTarget{start_.position_m, {}, start_.position_m, true};
  } else {
    target = choice_.choose({view_, space_, from, target_});
  }
  if (!target) return nothing_left();
  if (!target->is_goal && has_been_in_view(target->looks_at_m)) {
    choice_.give_up(*target);
    next_thought_ = now_;
    return;
  }
  if (!is_path_good_for(*target, from)) plan_to(*target, commit_m, time);
}

void ClosedLoop::nothing_left() {
  if (follower_.left_m() > 0.01) return;  // what is seen on the way may tell more
  target_.reset();
  if (!has_turned_since_) {
    phase_ = Phase::kTurn;
  } else if (!options_.goal_m && !is_going_home_) {
    is_going_home_ = true;
    next_thought_ = now_;
  } else {
    end(FlightEnd::kStuck);
  }
}

/// The margin that the place where a path begins leaves: less than planned if something has shown
/// up beside the vehicle.
std::optional<SweepPolicy> ClosedLoop::policy_from(const Eigen::Vector3d& p) const {
  for (const double share : {1.0, 0.3, 0.0}) {
    SweepPolicy policy = policy_;
    policy.margin_m *= share;
    if (MotionCheck(view_.map(), view_.field(), body_, policy).is_clear(p)) return policy;
  }
  return std::nullopt;
}

/// `time`: since it began to think where to.
void ClosedLoop::plan_to(const FlightTarget& target, double commit_m, const ThreadTime& time) {
  ++report_.plans;
  const Eigen::Vector3d from = follower_.place_at(commit_m);
  const auto policy = policy_from(from);
  if (!policy) return plan_failed(target);
  PlanOptions how;
  how.sweep = *policy;
  how.comfort_m = options_.comfort_m;
  if (options_.bounds) {  // the vehicle may have been blown out of them by a little
    how.bounds =
        SpaceBox{options_.bounds->low.cwiseMin(from), options_.bounds->high.cwiseMax(from)};
  }
  how.max_iterations = 4000;
  how.seed = options_.seed;
  auto path = plan_path(view_.map(), view_.field(), body_, from, target.p_world, how);
  if (path) {
    const double lock_m = std::min(commit_m, locked_m());
    std::vector<Eigen::Vector3d> points = follower_.piece(lock_m, commit_m);
    points.insert(points.end(), path->points.begin() + 1, path->points.end());
    const MotionCheck check(view_.map(), view_.field(), body_, *policy);
    pending_ = Pending{now_ + options_.plan_latency,
                       target,
                       smoothed(check, points, options_.comfort_m, how.bounds),
                       lock_m,
                       *policy,
                       cuts_};
    failures_ = 0;
  } else {
    plan_failed(target);
  }
  const double ms = time.ms();
  plan_ms_sum_ += ms;
  report_.plan_ms_max = std::max(report_.plan_ms_max, ms);
  if (ms > 1e3 * seconds(options_.plan_latency)) ++report_.late_plans;
}

void ClosedLoop::plan_failed(const FlightTarget& target) {
  constexpr int kVain = 3, kEnough = 20;
  ++report_.plans_failed;
  ++failures_;
  if (!target.is_goal && failures_ % kVain == 0) choice_.give_up(target);
  if (failures_ < kEnough) return;
  failures_ = 0;
  nothing_left();
}

void ClosedLoop::take_pending() {
  if (!pending_ || now_ < pending_->due) return;
  const Pending planned = std::move(*pending_);
  pending_.reset();
  if (planned.cuts != cuts_) {  // of a path that is flown no more
    next_thought_ = now_;
    return;
  }
  std::vector<Eigen::Vector3d> points = follower_.path_m() < planned.lock_m
                                            ? follower_.piece(follower_.path_m(), planned.lock_m)
                                            : std::vector{follower_.place_m()};
  points.insert(points.end(), planned.points.begin(), planned.points.end());
  follower_.follow(std::move(points));
  flown_policy_ = planned.policy;
  target_ = planned.target;
  is_blocked_ = false;
  has_turned_since_ = false;
  check_path();  // frames have come since it was planned
}

}  // namespace swiftlet
