// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/region_query.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "swiftlet/query/sweep/voxel_scan_private.hpp"

namespace swiftlet {
namespace {

/// Counts voxels one by one and remembers the nearest that is not free. [voxels]
class RegionCount {
 public:
  explicit RegionCount(const Eigen::Vector3d& origin) : origin_(origin) {}

  void add(const VoxelIndex& v, Occupancy state) {
    VoxelCounts& counts = voxels.counts;
    ++(state == Occupancy::kFree      ? counts.free
       : state == Occupancy::kUnknown ? counts.unknown
                                      : counts.occupied);
    if (state == Occupancy::kFree) return;
    const double square =
        (Eigen::Vector3d(v.x + 0.5, v.y + 0.5, v.z + 0.5) - origin_).squaredNorm();
    if (square >= nearest_square_) return;
    nearest_square_ = square;
    voxels.first_not_free = v;
  }

  RegionVoxels voxels;

 private:
  Eigen::Vector3d origin_;
  double nearest_square_ = std::numeric_limits<double>::infinity();
};

/// Calls visit(VoxelIndex, Occupancy) for every voxel of a box, whatever its state.
template <class Visit>
void for_each_voxel(const MapSnapshot& map, const VoxelBox& box,
                    const OccupancyThresholds& thresholds, Visit&& visit) {
  for (VoxelIndex v = box.first; v.z <= box.last.z; ++v.z) {
    for (v.y = box.first.y; v.y <= box.last.y; ++v.y) {
      for (v.x = box.first.x; v.x <= box.last.x; ++v.x)
        visit(v, thresholds.classify(map.log_odds(v)));
    }
  }
}

bool is_place(const Eigen::Vector3d& p_world) { return (p_world.array().abs() < 1e6).all(); }

/// Distance of a point from a cone; 0 inside. [any unit]
double distance_to_cone(const Eigen::Vector3d& from_tip, const Eigen::Vector3d& axis,
                        double half_angle_rad, double length) {
  // In the plane through the axis and the point, the cone is a triangle: along the axis and beside.
  const double along = from_tip.dot(axis);
  const Eigen::Vector2d p(along, (from_tip - along * axis).norm());
  const Eigen::Vector2d rim(length, length * std::tan(half_angle_rad));
  if (along >= 0.0 && along <= length && p.y() <= along * std::tan(half_angle_rad)) return 0.0;
  const double square = rim.squaredNorm();
  const double share = square > 0.0 ? std::clamp(p.dot(rim) / square, 0.0, 1.0) : 0.0;
  const double to_side = (p - share * rim).norm();
  const double to_end = (p - Eigen::Vector2d(length, std::min(p.y(), rim.y()))).norm();
  return std::min(to_side, to_end);
}

}  // namespace

Expected<RegionVoxels> voxels_in_body(const MapSnapshot& map, const BodyShape& body,
                                      const Transform<World, Body>& T_world_body,
                                      const OccupancyThresholds& thresholds) {
  if (!is_place(T_world_body.translation())) {
    return fail(ErrorCode::kUsage, "region", "its place cannot be used",
                "give a finite place within 1000 km of the origin");
  }
  const double voxels_per_m = 1.0 / map.voxel_m();
  const VoxelBox window = voxel_box(map.window());
  const Eigen::Matrix3d R = T_world_body.rotation().toRotationMatrix();
  const Eigen::Vector3d origin = T_world_body.translation() * voxels_per_m;
  const auto parts = body.parts();
  RegionCount count(origin);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const auto part_at = [&](std::size_t k) {
      return make_moving_part(parts[k], R, origin, Eigen::Vector3d::Zero(), voxels_per_m, 0.0);
    };
    const MovingPart part = part_at(i);
    const Eigen::Array3d extent = part.half_extent();
    const auto touched =
        touched_voxels(part.centre.array() - extent, part.centre.array() + extent, window);
    count.voxels.is_inside = count.voxels.is_inside && touched.is_inside;
    if (!touched.is_any) continue;
    for_each_voxel(map, touched.box, thresholds, [&](const VoxelIndex& v, Occupancy state) {
      if (!may_touch(part, cube_of(v))) return;
      for (std::size_t k = 0; k < i; ++k) {
        if (may_touch(part_at(k), cube_of(v))) return;  // counted with an earlier part
      }
      count.add(v, state);
    });
  }
  return count.voxels;
}

Expected<RegionVoxels> voxels_in_cone(const MapSnapshot& map, const ConeRegion& cone,
                                      const OccupancyThresholds& thresholds) {
  const double length = cone.axis_world.norm();
  const bool is_sound = is_place(cone.tip_world) && length > 0.0 && std::isfinite(length) &&
                        cone.half_angle_rad > 0.0 && cone.half_angle_rad < 0.5 * std::numbers::pi &&
                        cone.length_m >= 0.0 && cone.length_m <= 1e6;
  if (!is_sound) {
    return fail(ErrorCode::kUsage, "region", "the cone cannot be used",
                "give finite numbers, an axis that is not 0 and an angle below 90 degrees");
  }
  const double voxels_per_m = 1.0 / map.voxel_m();
  const Eigen::Vector3d axis = cone.axis_world / length;
  const Eigen::Vector3d tip = cone.tip_world * voxels_per_m;
  const double reach = cone.length_m * voxels_per_m;
  const double end_radius = reach * std::tan(cone.half_angle_rad);
  // The box around tip and end: a disc reaches along an axis by the sine of its angle to it.
  const Eigen::Array3d end = (tip + reach * axis).array();
  const Eigen::Array3d disc = end_radius * (1.0 - axis.array().square()).max(0.0).sqrt();
  const TouchedVoxels touched = touched_voxels(
      tip.array().min(end - disc), tip.array().max(end + disc), voxel_box(map.window()));
  RegionCount count(tip);
  count.voxels.is_inside = touched.is_inside;
  if (!touched.is_any) return count.voxels;
  const double half_diagonal = 0.5 * std::sqrt(3.0) + kSlack_voxels;
  for_each_voxel(map, touched.box, thresholds, [&](const VoxelIndex& v, Occupancy state) {
    const Eigen::Vector3d from_tip = cube_of(v).centre.matrix() - tip;
    if (distance_to_cone(from_tip, axis, cone.half_angle_rad, reach) <= half_diagonal)
      count.add(v, state);
  });
  return count.voxels;
}

}  // namespace swiftlet
