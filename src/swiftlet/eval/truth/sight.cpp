// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/truth/sight.hpp"

#if SWIFTLET_HAS_EMBREE

#include <cmath>

#include "swiftlet/base/contract.hpp"

namespace swiftlet::eval {

void lines_of_sight(const sim::RayCaster& world, const TrueView& view, const SightOptions& options,
                    std::vector<SightLine>& lines) {
  lines.clear();
  const PinholeIntrinsics& intrinsics = view.intrinsics;
  const Eigen::Matrix3d R = view.T_world_camera.rotation().toRotationMatrix();
  const Eigen::Vector3f eye = view.T_world_camera.translation().cast<float>();
  std::vector<Eigen::Vector3f> rays;
  std::vector<sim::Hit> hits;
  for (int v = options.stride_px / 2; v < intrinsics.height(); v += options.stride_px) {
    rays.clear();
    for (int u = options.stride_px / 2; u < intrinsics.width(); u += options.stride_px)
      rays.emplace_back((R * intrinsics.back_project(u, v, 1.0)).cast<float>());
    hits.resize(rays.size());
    world.cast(eye, rays, hits);
    for (std::size_t i = 0; i < rays.size(); ++i) {
      const double z_m = hits[i].distance;  // rays have a depth of 1
      if (!(z_m >= options.min_range_m && z_m <= options.max_range_m)) continue;
      if (hits[i].cos_incidence < options.min_cos_incidence) continue;
      lines.push_back({eye, eye + hits[i].distance * rays[i]});
    }
  }
}

void depths_in_view(const sim::RayCaster& world, const TrueView& view, const SightOptions& options,
                    std::span<const Eigen::Vector3f> points_m, float own_radius_m,
                    std::span<float> depths_m) {
  SWIFTLET_REQUIRE(points_m.size() == depths_m.size(), "one depth per point");
  const auto T_camera_world = view.T_world_camera.inverse();
  const Eigen::Vector3f eye = view.T_world_camera.translation().cast<float>();
  std::vector<Eigen::Vector3f> before;  // just in front of what the point is the middle of
  before.reserve(points_m.size());
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const Eigen::Vector3d p_camera = T_camera_world * points_m[i].cast<double>();
    depths_m[i] = 0.0F;
    const Eigen::Vector3f to_point = points_m[i] - eye;
    before.emplace_back(points_m[i] - std::min(1.5F * own_radius_m + 1e-3F, to_point.norm()) *
                                          to_point.normalized());
    if (p_camera.z() < options.min_range_m || p_camera.z() > options.max_range_m) continue;
    const Eigen::Vector2d pixel = view.intrinsics.project(p_camera);
    const bool is_in_view = pixel.x() >= 0.0 && pixel.y() >= 0.0 &&
                            pixel.x() <= view.intrinsics.width() - 1 &&
                            pixel.y() <= view.intrinsics.height() - 1;
    if (is_in_view) depths_m[i] = static_cast<float>(p_camera.z());
  }
  std::vector<std::uint8_t> is_seen(points_m.size());
  world.look(eye, before, is_seen);
  for (std::size_t i = 0; i < depths_m.size(); ++i) {
    if (is_seen[i] == 0) depths_m[i] = 0.0F;
  }
}

}  // namespace swiftlet::eval

#endif  // SWIFTLET_HAS_EMBREE
