// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace swiftlet::test {

/// The method once more, straight from its equations (method 2 to 6), in double precision and with
/// no code of the product: every voxel of the neighbourhood is clipped against every ray. Slow; for
/// small images and maps.
struct ReferenceMapper {
  // Camera.
  int width, height;
  double fx, fy, cx, cy;
  Eigen::Matrix4d T_world_camera;
  // Parameters, named as in the method.
  double c = 0.2, B = 0.05, s = 0.08, k = 0.2, p_min = 0.3, p_max = 0.97, step = 0.04;
  int n = 1;
  double min_range = 0.2, max_range = 10.0;

  using Voxel = std::array<int, 3>;

  /// Sum of DW * L_ism per voxel over one frame, in steps of a byte. depth: row-major metres, 0 =
  /// no reading.
  [[nodiscard]] std::map<Voxel, double> frame_sums(const std::vector<double>& depth,
                                                   const Voxel& low, const Voxel& high) const {
    std::map<Voxel, double> sums;
    for (int bv = 0; bv < height; bv += n) {
      for (int bu = 0; bu < width; bu += n) {
        double z_t = 0.0;
        int u_t = 0, v_t = 0;
        for (int v = bv; v < std::min(bv + n, height); ++v) {
          for (int u = bu; u < std::min(bu + n, width); ++u) {
            const double z = depth[static_cast<std::size_t>(v * width + u)];
            if (z < min_range || z > max_range || z == 0.0) continue;
            if (z_t == 0.0 || z < z_t) z_t = z, u_t = u, v_t = v;
          }
        }
        if (z_t > 0.0) add_ray(sums, u_t, v_t, z_t, low, high);
      }
    }
    return sums;
  }

 private:
  void add_ray(std::map<Voxel, double>& sums, int u, int v, double z_t, const Voxel& low,
               const Voxel& high) const {
    const double sigma = z_t * z_t * s / (fx * B);
    const Eigen::Vector4d far_camera =
        (z_t + 3 * sigma) * Eigen::Vector4d((u - cx) / fx, (v - cy) / fy, 1.0, 0.0) +
        Eigen::Vector4d(0, 0, 0, 1);
    const Eigen::Vector3d a = T_world_camera.topRightCorner<3, 1>();
    const Eigen::Vector3d b = (T_world_camera * far_camera).head<3>();
    const Eigen::Matrix4d T_camera_world = T_world_camera.inverse();
    for (int x = low[0]; x <= high[0]; ++x) {
      for (int y = low[1]; y <= high[1]; ++y) {
        for (int z = low[2]; z <= high[2]; ++z) {
          const Eigen::Vector4d centre((x + 0.5) * c, (y + 0.5) * c, (z + 0.5) * c, 1.0);
          const double to_line = (b - a).cross(centre.head<3>() - a).norm() / (b - a).norm();
          if (to_line > c || !crosses(a, b, Eigen::Vector3d(x, y, z) * c)) continue;
          const double z_voxel = (T_camera_world * centre).z();
          if (z_voxel <= 0.0) continue;
          sums[{x, y, z}] +=
              z_voxel * z_voxel * n * n / (fx * fy * c * c) * log_odds(z_voxel, z_t, sigma) / step;
        }
      }
    }
  }

  /// The segment a-b has length inside the voxel whose low corner is given.
  [[nodiscard]] bool crosses(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                             const Eigen::Vector3d& corner) const {
    double t0 = 0.0, t1 = 1.0;
    for (int i = 0; i < 3; ++i) {
      const double d = b[i] - a[i];
      if (std::abs(d) < 1e-12) {
        if (a[i] < corner[i] || a[i] >= corner[i] + c) return false;
        continue;
      }
      const double e = (corner[i] - a[i]) / d, f = (corner[i] + c - a[i]) / d;
      t0 = std::max(t0, std::min(e, f));
      t1 = std::min(t1, std::max(e, f));
    }
    return t1 - t0 > 1e-9;
  }

  /// Method 4 with its errata; the voxel is the slice of half a voxel on both sides of its centre.
  [[nodiscard]] double log_odds(double z_voxel, double z_t, double sigma) const {
    double d = z_voxel - z_t;
    if (std::abs(d) <= c / 2)
      d = 0.0;
    else
      d -= d > 0 ? c / 2 : -c / 2;
    if (d > 3 * sigma) return 0.0;
    const double p_base = d <= 0 ? p_min : 0.5;
    const double amplitude = k / (sigma * std::sqrt(2 * 3.14159265358979323846)) + 0.5 - p_base;
    const double p = std::min(p_max, p_base + amplitude * std::exp(-d * d / (2 * sigma * sigma)));
    return std::log(p / (1 - p));
  }
};

}  // namespace swiftlet::test
