// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>

#include "swiftlet/fly/closed_loop_private.hpp"

namespace swiftlet {
namespace {

constexpr double kPathStep_m = 0.1;     // between the points that are told of a path
constexpr double kMostPoints = 1000.0;  // of a long one, fewer a metre

}  // namespace

/// For who looks on: the same questions that the planner asks, changing nothing.
Course ClosedLoop::course() const {
  Course course;
  course.frame_count = view_.map().frame_count();
  course.goal_m = is_going_home_ ? std::optional(start_.position_m) : options_.goal_m;
  if (target_) {
    course.target_m = target_->p_world;
    if (!target_->is_goal) course.looks_at_m = target_->looks_at_m;
  }
  const double step_m = std::max(kPathStep_m, follower_.left_m() / kMostPoints);
  for (double s = follower_.path_m(); s < follower_.end_m() + step_m; s += step_m) {
    const Eigen::Vector3d p = follower_.place_at(std::min(s, follower_.end_m()));
    course.path.push_back({p, view_.field().sample(p, Obstacles::kNotFree).distance_m});
  }
  for (const FrontierCluster& cluster : cluster_frontier(view_.frontier()).clusters) {
    course.frontier.push_back(
        {cluster.centroid_m, static_cast<std::uint32_t>(cluster.voxel_count)});
  }
  return course;
}

}  // namespace swiftlet
