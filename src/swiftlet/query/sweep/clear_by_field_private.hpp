// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "swiftlet/query/distance/distance_field.hpp"
#include "swiftlet/query/sweep/path_piece_private.hpp"

namespace swiftlet {

/// What a distance field proves about a body that is not larger than a ball around its origin.
class ClearByField {
 public:
  /// `ball`: its radius, margin included [voxels].
  ClearByField(const DistanceField& field, Obstacles obstacles, double ball)
      : field_(field), obstacles_(obstacles), ball_(ball) {}

  /// How far the ball may move from here, whichever way, and still touch no obstacle; 0 or less
  /// proves nothing. [voxels]
  [[nodiscard]] double room(const Eigen::Vector3d& p) const {
    const VoxelIndex voxel = voxel_containing(p, 1.0);
    const DistanceAnswer answer = field_.distance(voxel, obstacles_);
    const double off_centre = (p - centre_of(voxel, 1.0)).norm();
    // From the centre of the voxel to that of the obstacle, which reaches half a diagonal farther.
    constexpr double kHalfDiagonal = 0.5 * std::numbers::sqrt3, kRounding = 1e-3;
    return answer.distance_m / field_.voxel_m() - off_centre - kHalfDiagonal - ball_ - kRounding;
  }

  /// Calls visit(begin, end), in order, for the stretches of a leg within [first, last] that
  /// nothing is proved about, until it returns false.
  template <class Visit>
  bool for_each_unsure(const PathLeg& leg, double first, double last, Visit&& visit) const {
    if (!(first < last)) return visit(first, last);
    constexpr double kStep = 1.0;  // in unsure space
    double unsure_from = first;
    for (double at = first; at < last;) {
      const double clear = room(leg.at(at));
      const double step = std::max(clear, kStep) / std::max(leg.length(), 1e-9);
      if (clear >= kStep) {
        if (unsure_from < at && !visit(unsure_from, at)) return false;
        unsure_from = at + step;
      }
      at += step;
    }
    return unsure_from >= last || visit(unsure_from, last);
  }

 private:
  const DistanceField& field_;
  Obstacles obstacles_;
  double ball_;
};

}  // namespace swiftlet
