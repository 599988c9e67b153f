// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/leave_out.hpp"

#include <algorithm>
#include <cstdlib>

#include "swiftlet/base/contract.hpp"

namespace swiftlet::eval {
namespace {

/// Whether a ray meets an occupied voxel more than two voxels, along any axis, from its end.
bool is_blocked(const Claims& claims, const GridRay& ray, const VoxelIndex& end) {
  constexpr std::int32_t kOwn = 2;
  const auto is_own = [&](const VoxelIndex& v) {
    return std::max({std::abs(v.x - end.x), std::abs(v.y - end.y), std::abs(v.z - end.z)}) <= kOwn;
  };
  const Clip clip = clip_to_box(ray, claims.box());
  if (clip.is_empty()) return false;
  GridWalk walk(ray, claims.box(), clip);
  do {
    if (claims.at(walk.voxel()) == Occupancy::kOccupied) return !is_own(walk.voxel());
  } while (walk.advance());
  return false;
}

}  // namespace

void append_readings(const Frame& frame, const PreprocessOptions& range, int stride_px,
                     std::vector<SightLine>& lines) {
  const Image<std::uint16_t>& raw = frame.depth.raw;
  const Eigen::Vector3f eye = frame.T_world_camera.translation().cast<float>();
  for (int v = stride_px / 2; v < raw.height(); v += stride_px) {
    for (int u = stride_px / 2; u < raw.width(); u += stride_px) {
      const double z_m = frame.depth.depth_m(u, v);  // 0 without a reading
      if (z_m == 0.0 || z_m < range.min_range_m || z_m > range.max_range_m) continue;
      const Eigen::Vector3d p = frame.T_world_camera * frame.intrinsics.back_project(u, v, z_m);
      lines.push_back({eye, p.cast<float>()});
    }
  }
}

VoxelBox box_around(std::span<const SightLine> lines, double voxel_m) {
  SWIFTLET_REQUIRE(!lines.empty(), "there is nothing to put a box around");
  constexpr double kMargin_voxels = 3.0;
  Eigen::Vector3f least = lines.front().eye_m;
  Eigen::Vector3f most = least;
  for (const SightLine& line : lines) {
    least = least.cwiseMin(line.eye_m).cwiseMin(line.point_m);
    most = most.cwiseMax(line.eye_m).cwiseMax(line.point_m);
  }
  const Eigen::Vector3d margin = Eigen::Vector3d::Constant(kMargin_voxels * voxel_m);
  return {voxel_containing(least.cast<double>() - margin, voxel_m),
          voxel_containing(most.cast<double>() + margin, voxel_m)};
}

Consistency consistency_of(const Claims& claims, std::span<const SightLine> lines, double voxel_m) {
  Consistency result;
  for (const SightLine& line : lines) {
    const Eigen::Vector3d point = line.point_m.cast<double>();
    const VoxelIndex end = voxel_containing(point, voxel_m);
    const GridRay ray{line.eye_m.cast<double>() / voxel_m, point / voxel_m};
    ++result.points;
    result.met += is_occupied_within(claims, end, 1) ? 1 : 0;
    result.blocked += is_blocked(claims, ray, end) ? 1 : 0;
  }
  return result;
}

}  // namespace swiftlet::eval
