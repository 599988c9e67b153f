// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/sim/random/cave_rock.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "swiftlet/base/narrow.hpp"

namespace swiftlet::sim {
namespace {

using Eigen::Vector2d;

constexpr double kMeets_m = 0.7;  // height at which floor and ceiling meet
constexpr double kMesh_m = 0.3;   // from corner to corner

double smooth(double x) {
  const double t = std::clamp(x, 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

double distance_to(const CaveRock::Passage& passage, const Vector2d& p) {
  const Vector2d along = passage.to_m - passage.from_m;
  const double length_2 = along.squaredNorm();
  const double share =
      length_2 > 0.0 ? std::clamp(along.dot(p - passage.from_m) / length_2, 0.0, 1.0) : 0.0;
  return (p - passage.from_m - share * along).norm();
}

}  // namespace

/// Random heights of -1 to 1 on a lattice, and smooth between them.
double CaveRock::roughness(const Vector2d& p, double scale_m, unsigned layer) const {
  const Vector2d at = p / scale_m;
  const double fx = std::floor(at.x()), fy = std::floor(at.y());
  const auto height = [&](int dx, int dy) {
    const auto x = static_cast<std::uint64_t>(static_cast<std::int64_t>(fx) + dx + 4096);
    const auto y = static_cast<std::uint64_t>(static_cast<std::int64_t>(fy) + dy + 4096);
    return 2.0 * static_cast<double>(random_.uniform(layer << 28U | x << 14U | y)) - 1.0;
  };
  const double sx = smooth(at.x() - fx), sy = smooth(at.y() - fy);
  return std::lerp(std::lerp(height(0, 0), height(1, 0), sx),
                   std::lerp(height(0, 1), height(1, 1), sx), sy);
}

CaveRock::Gap CaveRock::gap(const Vector2d& p) const {
  double open = 0.0, height_m = 0.0;
  for (const Passage& passage : passages_) {
    const double share = distance_to(passage, p) / passage.radius_m;
    const double here = std::max(0.0, 1.0 - share * share);
    open = std::max(open, here);
    height_m = std::max(height_m, passage.height_m * std::sqrt(here));
  }
  const double inner = smooth(3.0 * open);  // at the rim nothing is rough: there they meet
  const double floor_m = kMeets_m * (1.0 - smooth(2.5 * open)) +
                         inner * (0.12 * roughness(p, 1.1, 1) + 0.06 * roughness(p, 0.45, 2));
  const double ceiling_m =
      kMeets_m + height_m + inner * (0.25 * roughness(p, 1.4, 3) + 0.10 * roughness(p, 0.5, 4));
  return {std::min(floor_m, kMeets_m), std::max(ceiling_m, kMeets_m)};
}

TriangleMesh CaveRock::mesh() const {
  Vector2d low_m = Vector2d::Constant(1e9), high_m = -low_m;
  for (const Passage& passage : passages_) {
    const Vector2d reach = Vector2d::Constant(passage.radius_m + 2.0 * kMesh_m);
    low_m = low_m.cwiseMin(passage.from_m - reach).cwiseMin(passage.to_m - reach);
    high_m = high_m.cwiseMax(passage.from_m + reach).cwiseMax(passage.to_m + reach);
  }
  const int nx = static_cast<int>((high_m.x() - low_m.x()) / kMesh_m) + 1;
  const int ny = static_cast<int>((high_m.y() - low_m.y()) / kMesh_m) + 1;
  TriangleMesh mesh;
  std::vector<bool> is_open;
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      const Vector2d p = low_m + kMesh_m * Vector2d(x, y);
      const Gap here = gap(p);
      is_open.push_back(here.ceiling_m > here.floor_m);
      for (const double z : {here.floor_m, here.ceiling_m})
        mesh.vertices_m.push_back(Eigen::Vector3d(p.x(), p.y(), z).cast<float>());
    }
  }
  const auto corner = [&](int x, int y) { return static_cast<std::size_t>(y * nx + x); };
  for (int y = 0; y + 1 < ny; ++y) {
    for (int x = 0; x + 1 < nx; ++x) {
      const std::array<std::size_t, 4> c{corner(x, y), corner(x + 1, y), corner(x + 1, y + 1),
                                         corner(x, y + 1)};
      if (std::ranges::none_of(c, [&](std::size_t i) { return is_open[i]; })) continue;
      for (const std::size_t layer : {0U, 1U}) {
        const auto vertex = [&](std::size_t i) { return to<std::uint32_t>(2 * c[i] + layer); };
        mesh.triangles.push_back({vertex(0), vertex(1), vertex(2)});
        mesh.triangles.push_back({vertex(0), vertex(2), vertex(3)});
      }
    }
  }
  mesh.materials.resize(mesh.triangles.size());
  return mesh;
}

}  // namespace swiftlet::sim
