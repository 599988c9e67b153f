// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <cmath>

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

ScoreResult score_surface(const Judged& judged);

namespace {

struct Meeting {
  bool met = false;
  double offset_cells = 0.0;  // of the cell's middle behind the true surface, along the line
};

/// Follows a line of sight to its first occupied cell, up to `beyond` cells behind the surface.
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
    if (judged.claims.at(walk.cell()) != Occupancy::kOccupied) continue;
    const VoxelIndex v = walk.cell();
    const Eigen::Vector3d middle(v.x + 0.5, v.y + 0.5, v.z + 0.5);
    return {true, along.dot(middle - point)};
  } while (walk.advance());
  return {};
}

}  // namespace

/// A line of sight, cast through the map, should meet the first occupied cell at the true surface.
/// Blocked early: it meets one more than 1.5 cells before. Through: it meets none up to 1.5 cells
/// behind. Offset of the middle of the cell that it meets, of the other lines: mean (above 0: the
/// map lies too deep) and RMS; a perfect map has an RMS of some 0.4 cells.
ScoreResult score_surface(const Judged& judged) {
  constexpr double kTolerance_cells = 1.5;
  std::size_t all = 0, early = 0, through = 0, met = 0;
  double sum = 0.0, sum_of_squares = 0.0;
  for (const SightLine& line : judged.truth.sight_lines()) {
    ++all;
    const Meeting meeting = meet(judged, line, kTolerance_cells);
    if (!meeting.met) {
      ++through;
    } else if (meeting.offset_cells < -kTolerance_cells) {
      ++early;
    } else {
      ++met;
      sum += meeting.offset_cells;
      sum_of_squares += meeting.offset_cells * meeting.offset_cells;
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
