// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/sweep/sweep_path.hpp"

#include <fmt/format.h>

#include <cmath>

#include "swiftlet/map/rolling_map.hpp"

namespace swiftlet {
namespace {

bool is_within_reach(const Eigen::Vector3d& p_world) {  // false for NaN, too
  return (p_world.array().abs() < RollingMap::kMaxCoordinate_m).all();
}

tl::unexpected<Error> refuse_point(std::size_t i, const Eigen::Vector3d& p) {
  return fail(ErrorCode::kUsage, "path",
              fmt::format("point {} is ({}, {}, {})", i, p.x(), p.y(), p.z()),
              "give finite points within 1000 km of the origin");
}

tl::unexpected<Error> refuse_empty() {
  return fail(ErrorCode::kUsage, "path", "has no point", "give at least one");
}

}  // namespace

Expected<SweepPath> SweepPath::along(std::span<const Eigen::Vector3d> points_world) {
  if (points_world.empty()) return refuse_empty();
  for (std::size_t i = 0; i < points_world.size(); ++i) {
    if (!is_within_reach(points_world[i])) return refuse_point(i, points_world[i]);
  }
  SweepPath path;
  path.points_ = points_world;
  return path;
}

Expected<SweepPath> SweepPath::of(std::span<const TimedPose> poses) {
  if (poses.empty()) return refuse_empty();
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto& T = poses[i].T_world_body;
    if (!is_within_reach(T.translation())) return refuse_point(i, T.translation());
    if (!(std::abs(T.rotation().norm() - 1.0) < 1e-6)) {
      return fail(ErrorCode::kUsage, "path", fmt::format("the rotation of pose {} is not one", i),
                  "give unit quaternions");
    }
    if (i > 0 && poses[i].stamp < poses[i - 1].stamp) {
      return fail(ErrorCode::kUsage, "path",
                  fmt::format("time goes back at pose {}, from {} ns to {} ns", i,
                              poses[i - 1].stamp.ns, poses[i].stamp.ns),
                  "sort the poses by time");
    }
  }
  SweepPath path;
  path.poses_ = poses;
  return path;
}

}  // namespace swiftlet
