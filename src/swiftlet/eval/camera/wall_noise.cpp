// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/camera/wall_noise.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "swiftlet/base/contract.hpp"

namespace swiftlet::eval {

std::optional<WallNoise> measure_wall(const DepthImage& depth,
                                      const PinholeIntrinsics& intrinsics) {
  constexpr std::size_t kFewest = 100;
  const int u0 = intrinsics.width() / 3, u1 = 2 * intrinsics.width() / 3;
  const int v0 = intrinsics.height() / 3, v1 = 2 * intrinsics.height() / 3;
  const auto for_each_reading = [&](auto&& visit) {
    for (int v = v0; v < v1; ++v) {
      for (int u = u0; u < u1; ++u) {
        if (depth.raw.at(u, v) == 0) continue;
        const double z_m = depth.depth_m(u, v);
        visit(Eigen::Vector3d(intrinsics.back_project(u, v, 1.0)), z_m);
      }
    }
  };
  // 1 / z = n . (x, y, 1): ordinary least squares.
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Eigen::Vector3d b = Eigen::Vector3d::Zero();
  WallNoise wall;
  for_each_reading([&](const Eigen::Vector3d& ray, double z_m) {
    A += ray * ray.transpose();
    b += ray / z_m;
    wall.distance_m += z_m;
    ++wall.readings;
  });
  if (wall.readings < kFewest) return std::nullopt;
  const Eigen::Vector3d n = A.ldlt().solve(b);
  wall.tilt_rad = std::acos(std::clamp(std::abs(n.z()) / n.norm(), 0.0, 1.0));
  wall.distance_m /= static_cast<double>(wall.readings);
  double squares = 0.0;
  for_each_reading([&](const Eigen::Vector3d& ray, double z_m) {
    const double off = z_m - 1.0 / n.dot(ray);
    squares += off * off;
  });
  wall.rms_m = std::sqrt(squares / static_cast<double>(wall.readings));
  return wall;
}

double fit_subpixel_px(std::span<const WallNoise> walls, double focal_px, double baseline_m) {
  SWIFTLET_REQUIRE(!walls.empty(), "a fit needs a wall");
  double sum = 0.0;
  for (const WallNoise& wall : walls)
    sum += wall.rms_m * focal_px * baseline_m / (wall.distance_m * wall.distance_m);
  return sum / static_cast<double>(walls.size());
}

}  // namespace swiftlet::eval
