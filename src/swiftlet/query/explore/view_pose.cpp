// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/explore/view_pose.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace swiftlet {
namespace {

constexpr std::size_t kMostTried = 32;

std::vector<VoxelIndex> spread(std::span<const VoxelIndex> voxels) {
  std::vector<VoxelIndex> some;
  const std::size_t n = std::min(voxels.size(), kMostTried);
  for (std::size_t i = 0; i < n; ++i) some.push_back(voxels[i * voxels.size() / n]);
  return some;
}

/// Calls visit(pose) for the candidates, the most likely first, until it returns false.
template <class Visit>
void for_each_candidate(const FrontierCluster& cluster, double range_m, Visit&& visit) {
  constexpr int kDirections = 16;
  constexpr std::array<double, 3> kShares{0.4, 0.2, 0.65};  // of the range
  constexpr std::array<double, 3> kTilts{0.0, 0.35, -0.35};
  // The camera looks the way that the frontier's normal points, or anywhere if that is up or down.
  const double ahead_rad = std::atan2(cluster.normal.y(), cluster.normal.x());
  for (int i = 0; i < kDirections; ++i) {
    const int side = (i + 1) / 2 * (i % 2 == 0 ? 1 : -1);  // 0, -1, 1, -2, 2, ...
    const double yaw_rad = ahead_rad + side * 2.0 * std::numbers::pi / kDirections;
    for (const double share : kShares) {
      for (const double tilt : kTilts) {
        const double away_m = share * range_m;
        const Eigen::Vector3d back(-std::cos(yaw_rad), -std::sin(yaw_rad), tilt);
        if (!visit(level_pose(cluster.centroid_m + away_m * back, yaw_rad))) return;
      }
    }
  }
}

}  // namespace

Transform<World, Body> level_pose(const Eigen::Vector3d& p_world, double yaw_rad) {
  return Transform<World, Body>::trusted(
      Eigen::Quaterniond(Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ())), p_world);
}

std::size_t voxels_in_sight(const MapSnapshot& map, std::span<const VoxelIndex> voxels,
                            const Transform<World, Camera>& T_world_camera,
                            const ViewCamera& camera, const OccupancyThresholds& thresholds) {
  const auto T_camera_world = T_world_camera.inverse();
  std::size_t seen = 0;
  for (const VoxelIndex& voxel : voxels) {
    const Eigen::Vector3d p_world = centre_of(voxel, map.voxel_m());
    if (!camera.covers(T_camera_world * p_world)) continue;
    const RayHit hit = cast_ray(map, T_world_camera.translation(), p_world, thresholds);
    seen += hit.state == Occupancy::kFree ? 1 : 0;
  }
  return seen;
}

Expected<std::optional<ViewPose>> find_view(const MapSnapshot& map, const FrontierCluster& cluster,
                                            std::span<const VoxelIndex> voxels,
                                            const ViewCamera& camera, const BodyShape& body,
                                            const SweepPolicy& policy) {
  if (!camera.is_sound()) {
    return fail(ErrorCode::kUsage, "view", "the camera cannot be used",
                "give angles below 170 degrees and a range above 0");
  }
  const std::vector<VoxelIndex> some = spread(voxels);
  std::optional<ViewPose> best;
  std::optional<Error> error;
  for_each_candidate(cluster, camera.max_range_m, [&](const Transform<World, Body>& T_world_body) {
    const TimedPose here{{}, T_world_body};
    const auto path = SweepPath::of({&here, 1});
    if (!path) return true;  // too far from the origin to be anywhere
    const auto place = sweep(map, body, *path, policy);
    if (!place) {
      error = place.error();
      return false;
    }
    if (place->state != SweepState::kClear) return true;
    const std::size_t seen =
        voxels_in_sight(map, some, T_world_body * camera.T_body_camera, camera, policy.thresholds);
    if (seen > (best ? best->voxels_seen : 0)) best = ViewPose{T_world_body, seen, some.size()};
    return seen < some.size();
  });
  if (error) return tl::make_unexpected(std::move(*error));
  return best;
}

}  // namespace swiftlet
