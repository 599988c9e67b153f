// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/fly/target_choice.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "swiftlet/plan/motion_check.hpp"

namespace swiftlet {
namespace {

constexpr double kOnward = 1.5;       // what a metre to the goal counts, against one of known way
constexpr double kGivenUp_m = 0.7;    // around what was looked at in vain
constexpr double kKeep = 1.25;        // another target must be better by so much
constexpr double kSame_m = 1.2;       // two targets that look at places so near are one
constexpr double kUsualGain = 400.0;  // unknown voxels in sight that are worth a metre of way

double yaw_of(const Transform<World, Body>& T) {
  const Eigen::Vector3d ahead = T.rotation() * Eigen::Vector3d::UnitX();
  return std::atan2(ahead.y(), ahead.x());
}

/// Whether more than a skin of the unknown lies behind a voxel of the frontier: the voxel before a
/// surface on the border of two stays unknown, and no look changes that.
bool leads_on(const MapSnapshot& map, const OccupancyThresholds& thresholds, const VoxelIndex& v) {
  constexpr std::array<std::array<int, 3>, 6> kFaces{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  return std::ranges::any_of(kFaces, [&](const std::array<int, 3>& d) {
    const auto is_unknown = [&](int steps) {
      const VoxelIndex at{v.x + steps * d[0], v.y + steps * d[1], v.z + steps * d[2]};
      return thresholds.classify(map.log_odds(at)) == Occupancy::kUnknown;
    };
    return is_unknown(1) && is_unknown(2) && is_unknown(3);
  });
}

}  // namespace

bool TargetChoice::is_given_up(const Eigen::Vector3d& p) const {
  return std::ranges::any_of(given_up_, [&](const Eigen::Vector3d& vain) {
    return (p - vain).squaredNorm() < kGivenUp_m * kGivenUp_m;
  });
}

bool TargetChoice::is_allowed(const Eigen::Vector3d& p) const {
  return !options_.bounds || options_.bounds->contains(p);
}

/// The goal, or the reachable place nearest to it if the goal has no room but for its rim.
std::optional<FlightTarget> TargetChoice::goal_target(const TargetQuestion& question) const {
  if (!options_.goal_m) return std::nullopt;
  const double voxel_m = question.view.map().voxel_m();
  const VoxelIndex middle = voxel_containing(*options_.goal_m, voxel_m);
  const MotionCheck check(question.view.map(), question.view.field(), body_, policy_);
  if (question.space.path_m(middle) && check.is_clear(*options_.goal_m))
    return FlightTarget{*options_.goal_m, {}, *options_.goal_m, true};
  const int voxels = static_cast<int>(options_.goal_radius_m / voxel_m);
  std::optional<FlightTarget> nearest;
  double least_m = options_.goal_radius_m;
  for (int z = -voxels; z <= voxels; ++z) {
    for (int y = -voxels; y <= voxels; ++y) {
      for (int x = -voxels; x <= voxels; ++x) {
        const VoxelIndex v{middle.x + x, middle.y + y, middle.z + z};
        const Eigen::Vector3d p = centre_of(v, voxel_m);
        const double off_m = (p - *options_.goal_m).norm();
        if (off_m >= least_m || !is_allowed(p) || !question.space.path_m(v)) continue;
        least_m = off_m;
        nearest = FlightTarget{p, {}, p, true};
      }
    }
  }
  return nearest;
}

std::vector<TargetChoice::Candidate> TargetChoice::ranked(const TargetQuestion& question,
                                                          const FrontierClusters& found) const {
  std::vector<Candidate> candidates;
  for (const FrontierCluster& cluster : found.clusters) {
    Candidate candidate{cluster, {}, 0.0};
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const VoxelIndex& v : found.voxels_of(cluster)) {
      if (!leads_on(question.view.map(), policy_.thresholds, v)) continue;
      candidate.voxels.push_back(v);
      sum += centre_of(v, question.view.map().voxel_m());
    }
    if (candidate.voxels.size() < kFewVoxels) continue;
    const auto count = static_cast<double>(candidate.voxels.size());
    const Eigen::Vector3d middle = sum / count;
    if (is_given_up(middle)) continue;
    candidate.cluster.centroid_m = middle;
    const double there_m = (middle - question.from).norm();
    const double on_m = options_.goal_m ? kOnward * (*options_.goal_m - middle).norm() : 0.0;
    const double bonus_m = options_.goal_m ? 0.0 : std::min(2.0, 0.01 * count);
    candidate.guess = there_m + on_m - bonus_m;
    candidates.push_back(std::move(candidate));
  }
  std::ranges::stable_sort(candidates, {}, &Candidate::guess);
  return candidates;
}

std::optional<FlightTarget> TargetChoice::view_of(const TargetQuestion& question,
                                                  const Candidate& candidate) const {
  const auto view =
      find_view(question.view.map(), candidate.cluster, candidate.voxels, camera_, body_, policy_);
  if (!view || !*view) return std::nullopt;
  const Transform<World, Body>& T = (*view)->T_world_body;
  if (!is_allowed(T.translation()) || !question.space.path_m(T.translation())) return std::nullopt;
  return FlightTarget{T.translation(), yaw_of(T), candidate.cluster.centroid_m, false};
}

double TargetChoice::cost_of(const TargetQuestion& question, const FlightTarget& target,
                             double way_m) {
  // Nearer to the goal is worth more than near: else what is beside the vehicle comes first.
  if (options_.goal_m) return way_m + kOnward * (*options_.goal_m - target.looks_at_m).norm();
  const auto seen = gain_.unknown_in_sight(
      question.view.map(),
      level_pose(target.p_world, target.yaw_rad.value_or(0.0)) * camera_.T_body_camera, camera_);
  const double gain = static_cast<double>(seen.value_or(0)) / kUsualGain;
  return (0.5 + way_m) / (0.1 + std::sqrt(gain));
}

std::optional<FlightTarget> TargetChoice::choose(const TargetQuestion& question) {
  if (auto goal = goal_target(question)) return goal;
  const FrontierClusters found =
      cluster_frontier(question.view.frontier(), {.min_voxels = kFewVoxels});
  std::optional<FlightTarget> best;
  double least = std::numeric_limits<double>::max();
  std::size_t tried = 0, viewed = 0;
  for (const Candidate& candidate : ranked(question, found)) {
    if (tried == kMostTried || (tried >= kMostViews && best)) break;
    ++tried;
    if (viewed == kEnoughViews) break;
    const auto target = view_of(question, candidate);
    if (!target) continue;
    ++viewed;
    double cost = cost_of(question, *target, *question.space.path_m(target->p_world));
    const bool is_kept = question.current && !question.current->is_goal &&
                         (question.current->looks_at_m - target->looks_at_m).norm() < kSame_m;
    if (is_kept) cost /= kKeep;
    if (cost >= least) continue;
    least = cost;
    best = target;
  }
  return best;
}

}  // namespace swiftlet
