// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <thread>

#include "swiftlet/fly/closed_loop_private.hpp"
#include "swiftlet/fly/explored_share.hpp"

namespace swiftlet {
namespace {

constexpr Nanoseconds kTick{10'000'000};
constexpr Nanoseconds kTrackStep{100'000'000};
constexpr double kTurnRate_radps = 1.2;
constexpr double kJudged_m = 2.0;  // clearances above this are this
constexpr double kAtGoal_m = 0.3;
constexpr double kTrulyThere_m = 0.5;  // kAtGoal_m, what a follower is off, and drift

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2.0 * std::numbers::pi); }

SweepPolicy planning_policy(const FlyOptions& options) {
  SweepPolicy policy;
  policy.thresholds = options.mapper.occupancy;
  policy.margin_m = options.margin_m;
  return policy;
}

}  // namespace

ClosedLoop::ClosedLoop(FlightWorld world, FlownMapPtr map, PlannerView view, const BodyShape& body,
                       const ViewCamera& camera, const FlightStart& start,
                       const FlyOptions& options)
    : options_(options),
      start_(start),
      world_(std::move(world)),
      map_(std::move(map)),
      view_(std::move(view)),
      body_(body),
      camera_(camera),
      policy_(planning_policy(options)),
      choice_({options.goal_m, options.bounds, kAtGoal_m}, camera, body, policy_),
      follower_({options.max_speed_mps, options.max_acceleration_mps2}, start.position_m),
      flown_policy_(policy_),
      yaw_rad_(start.yaw_rad) {
  report_.least_clearance_m = kJudged_m;
}

FlightReport ClosedLoop::run() {
  const auto begun = std::chrono::steady_clock::now();
  while (!ended_) {
    now_ = now_ + kTick;
    if (options_.is_paced) std::this_thread::sleep_until(begun + (now_ - Stamp{}));
    world_.vehicle.advance(now_);
    judge();
    sense();
    decide();
    steer();
    if (seconds(now_ - Stamp{}) > options_.time_limit_s) end(FlightEnd::kOutOfTime);
    if (options_.is_unwanted && options_.is_unwanted()) end(FlightEnd::kStopped);
  }
  finish_report();
  return report_;
}

/// How much room there truly was.
void ClosedLoop::judge() {
  const sim::VehicleState& state = world_.vehicle.state();
  world_.truth.move_to(now_ - Stamp{});
  const double clearance_m = world_.truth.clearance_m(state.T_world_body(), kJudged_m);
  report_.least_clearance_m = std::min(report_.least_clearance_m, clearance_m);
  if (clearance_m <= 0.0) end(FlightEnd::kCollided);
  const Eigen::Vector3d& p = state.position_m;
  if (last_true_) report_.length_m += (p - *last_true_).norm();
  last_true_ = p;
  report_.top_speed_mps = std::max(report_.top_speed_mps, state.velocity_mps.norm());
  for (const double v : {p.x(), p.y(), p.z(), state.yaw_rad})
    report_.digest = mix_bits(report_.digest ^ std::bit_cast<std::uint64_t>(v));
  if ((now_ - Stamp{}) % kTrackStep == Nanoseconds{0}) report_.track.push_back(p);
}

void ClosedLoop::sense() {
  world_.rig.move_to(now_, world_.vehicle.state().T_world_body());
  while (auto frame = world_.rig.next()) take(*frame);
  if (map_due_ && now_ >= *map_due_) see_map();
}

void ClosedLoop::take(const Frame& frame) {
  if (map_due_ && options_.counts_measured_time) {
    ++report_.frames_dropped;
    return;
  }
  if (map_due_) see_map();  // the frame before is done by now
  ++report_.frames;
  const ThreadTime time;
  const bool is_taken = map_->integrate(frame);
  map_ms_ = time.ms();
  if (!is_taken) {
    ++report_.frames_refused;
    return;
  }
  if (frames_seen_ == 0) clear_start();
  map_due_ =
      now_ + (options_.counts_measured_time ? Nanoseconds(static_cast<std::int64_t>(map_ms_ * 1e6))
                                            : options_.map_latency);
}

/// Nobody has looked at the place where the vehicle stands; whoever put it there has.
void ClosedLoop::clear_start() {
  RollingMap& window = map_->window();
  const double radius_m = options_.start_clear_m, voxel_m = window.voxel_m();
  const Eigen::Vector3d around = Eigen::Vector3d::Constant(radius_m);
  const VoxelIndex low = voxel_containing(start_.position_m - around, voxel_m);
  const VoxelIndex high = voxel_containing(start_.position_m + around, voxel_m);
  for (VoxelIndex v = low; v.z <= high.z; ++v.z) {
    for (v.y = low.y; v.y <= high.y; ++v.y) {
      for (v.x = low.x; v.x <= high.x; ++v.x) {
        const bool is_near = (centre_of(v, voxel_m) - start_.position_m).norm() <= radius_m;
        if (!is_near || !window.window().contains(block_of(v))) continue;
        const bool is_seen =
            options_.mapper.occupancy.classify(window.log_odds(v)) != Occupancy::kUnknown;
        if (!is_seen) window.writable(block_of(v)).voxels[offset_in_block(v)] = kFreeVoxel;
      }
    }
  }
}

void ClosedLoop::see_map() {
  map_due_.reset();
  const ThreadTime time;
  view_.look_at(map_->window(), map_->frame_count());
  check_path();
  const double ms = map_ms_ + time.ms();
  ++frames_seen_;
  frame_ms_sum_ += ms;
  report_.frame_ms_max = std::max(report_.frame_ms_max, ms);
  if (ms > 1000.0 / options_.rate_hz) ++report_.deadline_misses;
  if (options_.on_course && view_.has_map()) options_.on_course(course());
}

/// Is the rest of the path still clear? With less margin than it was planned with, so that a voxel
/// that comes and goes at its rim does not stop the vehicle.
void ClosedLoop::check_path() {
  if (!view_.has_map() || follower_.left_m() < 0.01) return;
  SweepPolicy policy = flown_policy_;
  policy.margin_m *= 0.3;
  const auto points = follower_.piece(follower_.path_m(), follower_.end_m());
  const auto path = SweepPath::along(points);
  const auto answer = path ? sweep(view_.map(), body_, *path, policy)
                           : Expected<SweepAnswer>(tl::make_unexpected(path.error()));
  if (answer && answer->state == SweepState::kClear) return;
  const double clear_m = answer ? answer->clear_m : 0.0;  // what cannot be asked is not clear
  follower_.stop_at(follower_.path_m() + std::max(0.0, clear_m - 0.05));
  ++cuts_;
  ++report_.blocked;
  is_blocked_ = true;
  next_thought_ = now_;
}

void ClosedLoop::finish_report() {
  report_.end = *ended_;
  report_.time_s = seconds(now_ - Stamp{});
  report_.mean_speed_mps = report_.length_m / report_.time_s;
  report_.waiting_share = waiting_s_ / report_.time_s;
  const double voxel_m = map_->window().voxel_m();
  report_.known_m3 = static_cast<double>(map_->known_voxels()) * voxel_m * voxel_m * voxel_m;
  if (!options_.goal_m) {
    report_.known_share =
        explored_share(world_.truth, map_->window(), options_.mapper.occupancy, start_.position_m,
                       options_.body_radius_m, options_.bounds);
  }
  const Eigen::Vector3d goal = options_.goal_m.value_or(start_.position_m);
  report_.goal_distance_m = (world_.vehicle.state().position_m - goal).norm();
  if (report_.is_success() && report_.goal_distance_m > kTrulyThere_m)
    report_.end = FlightEnd::kMissed;
  for (const std::size_t lost : world_.rig.tally().lost) report_.frames_refused += lost;
  if (frames_seen_ > 0) report_.frame_ms = frame_ms_sum_ / static_cast<double>(frames_seen_);
  if (report_.plans > 0) report_.plan_ms = plan_ms_sum_ / static_cast<double>(report_.plans);
}

double ClosedLoop::wanted_yaw() const {
  constexpr double kAhead_m = 1.0, kNearEnd_m = 0.7;
  if (target_ && target_->yaw_rad && follower_.left_m() < kNearEnd_m) return *target_->yaw_rad;
  const Eigen::Vector3d way =
      follower_.place_at(follower_.path_m() + kAhead_m) - follower_.place_m();
  if (way.head<2>().norm() < 0.15) return yaw_rad_;
  return std::atan2(way.y(), way.x());
}

/// A place of the map lies elsewhere in truth, as the tracker has drifted: there the vehicle goes
/// that is steered by it.
void ClosedLoop::steer() {
  const double dt_s = seconds(kTick);
  follower_.advance(dt_s);
  const double most_rad = kTurnRate_radps * dt_s;
  if (phase_ == Phase::kTurn) {
    yaw_rad_ += most_rad;
    turned_rad_ += most_rad;
  } else if (phase_ != Phase::kWarmUp) {
    yaw_rad_ += std::clamp(wrapped(wanted_yaw() - yaw_rad_), -most_rad, most_rad);
  }
  const bool is_waiting = phase_ == Phase::kFly && follower_.left_m() < 0.01;
  if (is_waiting) waiting_s_ += dt_s;
  const sim::TrackerDrift drift = world_.rig.drift();
  sim::Setpoint setpoint = follower_.setpoint();
  *setpoint.position_m -= drift.offset_m;
  setpoint.yaw_rad = yaw_rad_ - drift.yaw_rad;
  if (!world_.vehicle.command(setpoint, now_)) end(FlightEnd::kStopped);
}

}  // namespace swiftlet
