// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <cmath>

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

ScoreResult score_surface(const Judged& judged);

namespace {

struct Meeting {
  bool met = false;
  double offset_voxels = 0.0;  // of the voxel's middle behind the true surface, along the line
};

/// Follows a line of sight to its first occupied voxel, up to `beyond` voxels behind the surface.
Meeting meet(const Judged& judged, const SightLine& line, double beyond) {
  const double voxel_m = judged.truth.voxel_m();
  const Eigen::Vector3d eye = line.eye_m.cast<double>() / voxel_m;
  const Eigen::Vector3d point = line.point_m.cast<double>() / voxel_m;
  const double length = (point - eye).norm();
  const Eigen::Vector3d along = (point - eye) / length;
  const GridRay ray{eye, point + beyond * along};
  const Clip clip = clip_to_box(ray, judged.claims.box());
  if (clip.is_empty()) return {};
  GridWalk walk(ray, judged.claims.box(), clip);
  do {
    if (judged.claims.at(walk.voxel()) != Occupancy::kOccupied) continue;
    const VoxelIndex v = walk.voxel();
    const Eigen::Vector3d middle(v.x + 0.5, v.y + 0.5, v.z + 0.5);
    return {true, along.dot(middle - point)};
  } while (walk.advance());
  return {};
}

}  // namespace

/// A line of sight, cast through the map, should meet the first occupied voxel at the true surface.
/// Blocked early: it meets one more than 1.5 voxels before. Through: it meets none up to 1.5 voxels
/// behind. Offset of the middle of the voxel that it meets, of the other lines: mean (above 0: the
/// map lies too deep) and RMS; a perfect map has an RMS of some 0.4 voxels.
ScoreResult score_surface(const Judged& judged) {
  constexpr double kTolerance_voxels = 1.5;
  std::size_t all = 0, early = 0, through = 0, met = 0;
  double sum = 0.0, sum_of_squares = 0.0;
  for (const SightLine& line : judged.truth.sight_lines()) {
    ++all;
    const Meeting meeting = meet(judged, line, kTolerance_voxels);
    if (!meeting.met) {
      ++through;
    } else if (meeting.offset_voxels < -kTolerance_voxels) {
      ++early;
    } else {
      ++met;
      sum += meeting.offset_voxels;
      sum_of_squares += meeting.offset_voxels * meeting.offset_voxels;
    }
  }
  if (all == 0) return {};
  const double count = met == 0 ? 1.0 : static_cast<double>(met);
  const double voxel_m = judged.truth.voxel_m();
  return {{share("lines of sight blocked early", early, all, false),
           share("lines of sight that pass a surface", through, all, false),
           {"surface offset, |mean|", std::abs(voxel_m * sum / count), Unit::kMetres, false, met},
           {"surface offset, RMS", voxel_m * std::sqrt(sum_of_squares / count), Unit::kMetres,
            false, met}},
          {}};
}

}  // namespace swiftlet::eval
