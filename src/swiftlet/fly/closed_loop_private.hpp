// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <optional>
#include <vector>

#include "swiftlet/fly/fly.hpp"
#include "swiftlet/fly/path_follower.hpp"
#include "swiftlet/fly/planner_view.hpp"
#include "swiftlet/fly/target_choice.hpp"
#include "swiftlet/fly/thread_time_private.hpp"
#include "swiftlet/plan/planned_path.hpp"
#include "swiftlet/plan/reachable_space.hpp"
#include "swiftlet/sim/vehicle/true_clearance.hpp"
#include "swiftlet/source/sim/steered_rig.hpp"

namespace swiftlet {

/// The simulated half of a flight: the world, the rig in it and the vehicle that carries it.
struct FlightWorld {
  sim::TrueClearance truth;
  SteeredRig rig;
  sim::VehicleModel vehicle;
};

/// One flight: what flies on board, and the world around it, in steps of the control loop.
class ClosedLoop {
 public:
  ClosedLoop(FlightWorld world, FlownMapPtr map, PlannerView view, const BodyShape& body,
             const ViewCamera& camera, const FlightStart& start, const FlyOptions& options);
  [[nodiscard]] FlightReport run();

 private:
  enum class Phase : std::uint8_t { kWarmUp, kTurn, kFly, kLook };
  /// A path that the planner works on: it is flown from `due` on, unless the one before it has been
  /// cut since.
  struct Pending {
    Stamp due;
    FlightTarget target;
    std::vector<Eigen::Vector3d> points;  // from the lock on
    double lock_m;                        // on the path flown now
    SweepPolicy policy;
    std::size_t cuts;
  };

  void sense();
  void take(const Frame& frame);
  void see_map();
  void check_path();
  void decide();
  void think();
  void nothing_left();
  void plan_to(const FlightTarget& target, double commit_m, const ThreadTime& time);
  void plan_failed(const FlightTarget& target);
  void take_pending();
  void arrive();
  void turn();
  void steer();
  void judge();
  [[nodiscard]] bool is_path_good_for(const FlightTarget& target,
                                      const Eigen::Vector3d& from) const;
  [[nodiscard]] std::optional<SweepPolicy> policy_from(const Eigen::Vector3d& p) const;
  [[nodiscard]] double wanted_yaw() const;
  [[nodiscard]] double locked_m() const;
  [[nodiscard]] bool has_looked_in_vain(const Eigen::Vector3d& p);
  [[nodiscard]] bool has_been_in_view(const Eigen::Vector3d& p);
  [[nodiscard]] std::vector<VoxelIndex> frontier_near(const Eigen::Vector3d& p) const;
  void clear_start();
  [[nodiscard]] Course course() const;
  void finish_report();
  /// What ended it first stays: a collision on the last metre is one.
  void end(FlightEnd how) { ended_ = ended_.value_or(how); }

  FlyOptions options_;
  FlightStart start_;
  FlightWorld world_;
  FlownMapPtr map_;
  PlannerView view_;
  BodyShape body_;
  ViewCamera camera_;
  SweepPolicy policy_;  // of planning
  TargetChoice choice_;
  ReachableSpace space_;
  PathFollower follower_;
  SweepPolicy flown_policy_;  // that the path being flown was planned with

  Stamp now_{};
  Phase phase_ = Phase::kWarmUp;
  std::optional<FlightEnd> ended_;
  std::optional<Stamp> map_due_;  // when the planner sees what was integrated last
  std::optional<Pending> pending_;
  std::optional<FlightTarget> target_;
  Stamp next_thought_{};
  Stamp looking_until_{};
  std::size_t cuts_ = 0;  // of paths, by what new frames showed
  bool is_blocked_ = false;
  bool has_turned_since_ = false;  // since the last path was flown
  bool is_going_home_ = false;
  std::vector<Eigen::Vector3d> looked_at_;  // from targets that were reached
  std::vector<Eigen::Vector3d> seen_;       // on the way to targets, one a thought
  int failures_ = 0;                        // plans in a row
  double yaw_rad_ = 0.0;
  double turned_rad_ = 0.0;
  std::optional<Eigen::Vector3d> last_true_;
  double waiting_s_ = 0.0;
  double frame_ms_sum_ = 0.0, plan_ms_sum_ = 0.0;
  double map_ms_ = 0.0;  // of the frame that waits to be seen
  std::size_t frames_seen_ = 0;
  FlightReport report_;
};

}  // namespace swiftlet
