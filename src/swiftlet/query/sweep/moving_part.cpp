// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <cmath>

#include "swiftlet/query/sweep/moving_part_private.hpp"

namespace swiftlet {
namespace {

constexpr int kRounds = 24;  // far more than most gaps take; what is undecided then counts as touch

}  // namespace

MovingPart make_moving_part(const BodyShape::Part& part, const Eigen::Matrix3d& R,
                            const Eigen::Vector3d& middle, const Eigen::Vector3d& half_move,
                            double voxels_per_m, double extra_radius) {
  constexpr double kTiny_voxels = 1e-9;
  MovingPart moving;
  moving.centre = middle + R * (part.centre_m * voxels_per_m);
  moving.radius = part.radius_m * voxels_per_m + extra_radius;
  moving.half[0] = half_move;
  for (std::size_t i = 1; i < moving.half.size(); ++i) {
    const bool is_edge = static_cast<int>(i) <= part.edge_count;
    moving.half[i] = is_edge ? Eigen::Vector3d(R * (part.half_edges_m[i - 1] * voxels_per_m))
                             : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }
  for (std::size_t i = 0; i < moving.half.size(); ++i) {
    moving.square[i] = moving.half[i].squaredNorm();
    if (moving.square[i] >= kTiny_voxels * kTiny_voxels) continue;
    moving.radius += std::sqrt(moving.square[i]);  // too short to divide by
    moving.square[i] = 0.0;
    moving.half[i].setZero();
  }
  return moving;
}

void GapSearch::slide(std::size_t i, double to) {
  between_ += (to - share_[i]) * part_.half[i].array();
  share_[i] = to;
  settle();
}

void GapSearch::improve() {
  for (std::size_t i = 0; i < part_.half.size(); ++i) {
    if (part_.square[i] == 0.0) continue;
    const Eigen::Array3d half = part_.half[i].array();
    for (int step = 0; step < 3; ++step) {
      const double slope = (outside_ * half).sum();
      const double curvature = (outside_ != 0.0).select(half.square(), 0.0).sum();
      if (slope == 0.0 || curvature == 0.0) break;
      const double before = share_[i], square_before = square_;
      const double newton = std::clamp(before - slope / curvature, -1.0, 1.0);
      if (newton == before) break;
      slide(i, newton);
      if (square_ <= square_before) continue;
      // Too far, over a bend of the parabolas. With the whole square it is never too far.
      slide(i, std::clamp(before - slope / part_.square[i], -1.0, 1.0));
    }
  }
}

double GapSearch::at_least() const {
  if (square_ == 0.0) return 0.0;
  double width = (outside_ * start_).sum() - half_edge_ * outside_.abs().sum();
  for (const Eigen::Vector3d& half : part_.half) width -= std::abs((outside_ * half.array()).sum());
  return width / std::sqrt(square_);
}

bool may_touch(const MovingPart& part, const GridCube& cube) {
  const double reach = part.radius + kSlack_voxels;
  GapSearch search(part, cube);
  for (int round = 0; round < kRounds; ++round) {
    if (search.at_most() <= reach) return true;
    if (search.at_least() > reach) return false;
    search.improve();
  }
  return !(search.at_least() > reach);
}

Gap gap_between(const MovingPart& part, const GridCube& cube, double enough) {
  constexpr double kExact_voxels = 0.01;
  GapSearch search(part, cube);
  double at_least = search.at_least();
  double along = search.along();
  for (int round = 0; round < kRounds; ++round) {
    const bool is_decided = at_least - part.radius >= enough || search.at_most() <= part.radius ||
                            search.at_most() - at_least < kExact_voxels;
    if (is_decided) break;
    search.improve();
    along = search.along();
    at_least = std::max(at_least, search.at_least());
  }
  return {std::max(0.0, at_least - part.radius), along};
}

}  // namespace swiftlet
