// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/plan/path_smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace swiftlet {
namespace {

constexpr double kSpacing_voxels = 2.0;
constexpr int kPasses = 40;
constexpr double kTension = 0.5;       // share of the way to the middle of its neighbours
constexpr double kPush = 0.3;          // share of the comfort that is lacking
constexpr double kLongestMove = 0.25;  // of the spacing, a pass

/// Points on a polyline, evenly spaced leg by leg; its corners are among them.
std::vector<Eigen::Vector3d> with_points_between(const std::vector<Eigen::Vector3d>& points,
                                                 double spacing_m) {
  std::vector<Eigen::Vector3d> dense{points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Eigen::Vector3d leg = points[i] - points[i - 1];
    const int pieces = std::max(1, static_cast<int>(leg.norm() / spacing_m));
    for (int k = 1; k < pieces; ++k) dense.push_back(points[i - 1] + leg * k / pieces);
    dense.push_back(points[i]);
  }
  return dense;
}

/// The least room on a piece of the way, as far as comfort asks for it. [m]
double least_room_m(const MotionCheck& check, const Eigen::Vector3d& from,
                    const Eigen::Vector3d& to, double comfort_m) {
  const double step_m = kSpacing_voxels * check.map().voxel_m();
  double least_m = comfort_m;
  for (const Eigen::Vector3d& p : with_points_between({from, to}, step_m))
    least_m = std::min(least_m, check.room_m(p));
  return least_m;
}

}  // namespace

std::vector<Eigen::Vector3d> shortened(const MotionCheck& check,
                                       std::vector<Eigen::Vector3d> points, double comfort_m) {
  std::vector<double> room_m;  // of each leg
  for (std::size_t i = 1; i < points.size(); ++i)
    room_m.push_back(least_room_m(check, points[i - 1], points[i], comfort_m));
  std::vector<Eigen::Vector3d> kept{points.front()};
  for (std::size_t i = 0; i + 1 < points.size();) {
    std::size_t to = points.size() - 1;
    for (; to > i + 1; --to) {
      const double before_m = *std::min_element(room_m.begin() + static_cast<std::ptrdiff_t>(i),
                                                room_m.begin() + static_cast<std::ptrdiff_t>(to));
      if (least_room_m(check, points[i], points[to], comfort_m) >= before_m &&
          check.is_clear(points[i], points[to]))
        break;
    }
    kept.push_back(points[to]);
    i = to;
  }
  return kept;
}

std::vector<Eigen::Vector3d> smoothed(const MotionCheck& check,
                                      const std::vector<Eigen::Vector3d>& points, double comfort_m,
                                      const std::optional<SpaceBox>& bounds) {
  const double spacing_m = kSpacing_voxels * check.map().voxel_m();
  std::vector<Eigen::Vector3d> band = with_points_between(points, spacing_m);
  for (int pass = 0; pass < kPasses; ++pass) {
    double farthest_m = 0.0;
    for (std::size_t i = 1; i + 1 < band.size(); ++i) {
      const double lack_m = std::max(0.0, comfort_m - check.room_m(band[i]));
      Eigen::Vector3d move = kTension * (0.5 * (band[i - 1] + band[i + 1]) - band[i]) +
                             kPush * lack_m * check.way_out(band[i]);
      const double longest_m = kLongestMove * spacing_m;
      if (move.norm() > longest_m) move *= longest_m / move.norm();
      Eigen::Vector3d to = band[i] + move;
      if (bounds) to = to.cwiseMax(bounds->low).cwiseMin(bounds->high);
      if (!check.is_clear(band[i - 1], to) || !check.is_clear(to, band[i + 1])) continue;
      farthest_m = std::max(farthest_m, move.norm());
      band[i] = to;
    }
    if (farthest_m < 0.01 * spacing_m) break;
  }
  return band;
}

}  // namespace swiftlet
