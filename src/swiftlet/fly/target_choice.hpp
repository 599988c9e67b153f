// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "swiftlet/fly/planner_view.hpp"
#include "swiftlet/plan/plan_options.hpp"
#include "swiftlet/plan/reachable_space.hpp"
#include "swiftlet/query/explore/frontier_clusters.hpp"
#include "swiftlet/query/explore/view_camera.hpp"
#include "swiftlet/query/explore/view_gain.hpp"
#include "swiftlet/query/explore/view_pose.hpp"

namespace swiftlet {

/// Where a vehicle flies next: to its goal, or to where it sees more.
struct FlightTarget {
  Eigen::Vector3d p_world = Eigen::Vector3d::Zero();
  std::optional<double> yaw_rad{};       ///< to look that way there
  Eigen::Vector3d looks_at_m = p_world;  ///< the middle of the frontier
  bool is_goal = false;
};

/// What a choice is made of.
struct TargetQuestion {
  const PlannerView& view;
  const ReachableSpace& space;  ///< from where the vehicle can turn to another path
  Eigen::Vector3d from;
  std::optional<FlightTarget> current{};
};

/// Chooses the target: the goal if there is a known way to it; else a view of the frontier. On the
/// way to a goal, the one with the shortest way there and on to the goal; exploring, the one that
/// shows most for its way. A target is kept until another one is better by a quarter.
class TargetChoice {
 public:
  struct Options {
    std::optional<Eigen::Vector3d> goal_m{};
    std::optional<SpaceBox> bounds{};
    double goal_radius_m = 0.3;  ///< where the goal itself has no room, so near will do
  };
  static constexpr std::size_t kFewVoxels = 8;  ///< of a frontier that counts

  TargetChoice(const Options& options, const ViewCamera& camera, const BodyShape& body,
               const SweepPolicy& policy)
      : options_(options), camera_(camera), body_(body), policy_(policy) {}

  /// Nullopt: there is nothing within reach. Cost: milliseconds; a view is looked for around the
  /// few best clusters, at most kMostTried times.
  [[nodiscard]] std::optional<FlightTarget> choose(const TargetQuestion& question);
  /// It was looked at and did not go away: glass, a black wall. Not to be chosen again.
  void give_up(const FlightTarget& target) { given_up_.push_back(target.looks_at_m); }

 private:
  static constexpr std::size_t kMostViews = 24;
  static constexpr std::size_t kMostTried = 80;  // if none of them can be seen from anywhere
  static constexpr std::size_t kEnoughViews = 4;
  struct Candidate {
    FrontierCluster cluster;
    std::vector<VoxelIndex> voxels;  // of the cluster, those that lead on
    double guess;                    // of its cost, before a view is known; less is better
  };
  [[nodiscard]] std::optional<FlightTarget> goal_target(const TargetQuestion& question) const;
  [[nodiscard]] std::vector<Candidate> ranked(const TargetQuestion& question,
                                              const FrontierClusters& found) const;
  [[nodiscard]] std::optional<FlightTarget> view_of(const TargetQuestion& question,
                                                    const Candidate& candidate) const;
  [[nodiscard]] double cost_of(const TargetQuestion& question, const FlightTarget& target,
                               double way_m);
  [[nodiscard]] bool is_given_up(const Eigen::Vector3d& p) const;
  [[nodiscard]] bool is_allowed(const Eigen::Vector3d& p) const;

  Options options_;
  ViewCamera camera_;
  BodyShape body_;
  SweepPolicy policy_;
  ViewGain gain_;
  std::vector<Eigen::Vector3d> given_up_;
};

}  // namespace swiftlet
