// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/camera/distortion_fit.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "swiftlet/base/narrow.hpp"
#include "swiftlet/preprocess/depth_step.hpp"

namespace swiftlet::eval {
namespace {

using Terms = Eigen::Matrix<double, 5, 1>;  // x2, y2, x1, y1, 1

Terms terms_of(const Eigen::Vector3d& p) {
  return {p.x() * p.x(), p.y() * p.y(), p.x(), p.y(), 1.0};
}

/// Calls visit(u, v, point) for readings evenly over the images, half a million at most.
template <class Visit>
void for_each_point(const WallImages& wall, Visit&& visit) {
  constexpr std::size_t kMost = 500'000;
  const PinholeIntrinsics& k = wall.intrinsics;
  const std::size_t pixels = static_cast<std::size_t>(k.width()) *
                             static_cast<std::size_t>(k.height()) * wall.images.size();
  // Odd, so that it does not fall on the same columns in every row.
  const auto every = static_cast<int>(pixels / kMost) | 1;
  int next = 0;
  for (const DepthImage& depth : wall.images) {
    for (int v = 0; v < depth.raw.height(); ++v) {
      for (; next < depth.raw.width(); next += every) {
        const int u = next;
        if (depth.raw.at(u, v) == 0) continue;
        visit(u, v, k.back_project(u, v, double{depth.unit_m} * depth.raw.at(u, v)));
      }
      next -= depth.raw.width();
    }
  }
}

/// Least squares over the readings within `reach_m` of `before`; the RMS about it and the count.
struct Round {
  Terms p = Terms::Zero();
  double rms_m = 0.0;
  std::size_t readings = 0;
};
Round fit_round(const WallImages& wall, const Terms& before, double reach_m) {
  Eigen::Matrix<double, 5, 5> A = Eigen::Matrix<double, 5, 5>::Zero();
  Terms b = Terms::Zero();
  double squares = 0.0;
  Round round;
  for_each_point(wall, [&](int, int, const Eigen::Vector3d& p) {
    const Terms terms = terms_of(p);
    if (std::abs(p.z() - before.dot(terms)) > reach_m) return;
    A += terms * terms.transpose();
    b += p.z() * terms;
    squares += p.z() * p.z();
    ++round.readings;
  });
  if (round.readings == 0) return round;
  round.p = A.ldlt().solve(b);
  const double left = squares - 2.0 * round.p.dot(b) + round.p.dot(A * round.p);
  round.rms_m = std::sqrt(std::max(left, 0.0) / static_cast<double>(round.readings));
  return round;
}

constexpr int kTilesX = 16, kTilesY = 9;
constexpr std::size_t kTiles = std::size_t{kTilesX} * kTilesY;

/// Sum and count of the depths of each tile.
struct Tile {
  double sum_m = 0.0;
  std::size_t readings = 0;
};
std::array<Tile, kTiles> tiles_of(const WallImages& wall) {
  std::array<Tile, kTiles> tiles{};
  const int width = wall.intrinsics.width(), height = wall.intrinsics.height();
  for_each_point(wall, [&](int u, int v, const Eigen::Vector3d& p) {
    const int place = v * kTilesY / height * kTilesX + u * kTilesX / width;
    Tile& tile = tiles[to<std::size_t>(place)];
    tile.sum_m += p.z();
    ++tile.readings;
  });
  return tiles;
}

}  // namespace

Expected<DistortionFit> fit_distortion(const WallImages& wall, std::optional<double> distance_m) {
  constexpr std::size_t kFewest = 1000;
  constexpr double kOutlier = 4.0;
  const auto tiles = tiles_of(wall);
  const auto empty = std::ranges::count(tiles, std::size_t{0}, &Tile::readings);
  if (4 * empty > std::ssize(tiles)) {
    return fail(ErrorCode::kCorruptInput, {}, "the wall does not fill the image",
                "go nearer, or choose a larger and better textured one");
  }
  Round round = fit_round(wall, Terms::Zero(), std::numeric_limits<double>::infinity());
  for (int i = 0; i < 3; ++i) round = fit_round(wall, round.p, kOutlier * round.rms_m + 1e-6);
  if (round.readings < kFewest) {
    return fail(ErrorCode::kCorruptInput, {},
                "there are fewer than 1000 readings that agree on a wall", "face a flat wall");
  }
  DistortionFit fit;
  fit.distance_m = distance_m.value_or(round.p[4]);
  fit.distortion = {round.p[0], round.p[1], round.p[2], round.p[3], round.p[4] - fit.distance_m};
  fit.rms_m = round.rms_m;
  fit.readings = round.readings;
  return fit;
}

double tilt_rad(const DepthDistortion& distortion) {
  return std::atan(std::hypot(distortion.x1, distortion.y1));
}

WallImages straightened(const WallImages& wall, const DepthDistortion& distortion) {
  PreprocessOptions options;
  options.distortion = distortion;
  const auto step = find_registered(depth_steps(), "distortion", "depth step")->make(options);
  WallImages straight{{}, wall.intrinsics};
  for (const DepthImage& image : wall.images) {
    PreprocessedDepth depth;
    depth.raw = image.raw;
    depth.unit_m = image.unit_m;
    depth.intrinsics = wall.intrinsics;
    step->apply(depth);
    straight.images.push_back({std::move(depth.raw), image.unit_m});
  }
  return straight;
}

double worst_error(const WallImages& wall, double distance_m) {
  constexpr std::size_t kFewest = 20;
  double worst = 0.0;
  for (const Tile& tile : tiles_of(wall)) {
    if (tile.readings < kFewest) continue;
    const double mean_m = tile.sum_m / static_cast<double>(tile.readings);
    worst = std::max(worst, std::abs(mean_m / distance_m - 1.0));
  }
  return worst;
}

}  // namespace swiftlet::eval
