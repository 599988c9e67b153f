// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <algorithm>
#include <cmath>
#include <optional>

#include "swiftlet/base/angle.hpp"
#include "swiftlet/eval/score/score.hpp"
#include "swiftlet/eval/truth/wall_faces.hpp"

namespace swiftlet::eval {

ScoreResult score_walls(const Judged& judged);

namespace {

struct Column {
  double along_m;
  double offset_m;  // of the map's surface in front of the true one
};

/// Where the map has a wall, as a line in plan, and how far its columns stray from it.
struct FittedWall {
  WallFace face;
  double slope = 0.0;  // metres in front per metre along
  double rms_m = 0.0;
  std::size_t columns = 0;
  std::size_t straight = 0;  // columns within half a voxel of the line
};

/// Whether something else stands before a place on a wall, or before one a voxel beside it: that is
/// what the map shows there.
bool is_obstructed(const Truth& truth, const WallFace& face, const Eigen::Vector3d& p) {
  const double c = truth.voxel_m();
  const auto stands_before = [&](const Eigen::Vector3d& q) {
    const VoxelIndex behind_face = voxel_containing(q - 0.25 * c * face.normal, c);
    const VoxelIndex at_face = voxel_containing(q, c);
    for (double height = 0.25; height <= 2.5; height += 0.25) {  // in voxels
      const VoxelIndex v = voxel_containing(q + height * c * face.normal, c);
      if (v != behind_face && v != at_face && truth.holds_matter(v)) return true;
    }
    return false;
  };
  for (const double along : {-c, 0.0, c}) {
    for (const double up : {-c, 0.0, c}) {
      if (stands_before(p + along * face.along + up * Eigen::Vector3d::UnitZ())) return true;
    }
  }
  return false;
}

/// Offset of the first occupied voxel along the inward normal, within two voxels of the true
/// surface.
std::optional<double> offset_at(const Judged& judged, const WallFace& face,
                                const Eigen::Vector3d& p) {
  const double c = judged.truth.voxel_m();
  const VoxelIndex own = voxel_containing(p - 0.25 * c * face.normal, c);
  if (!judged.claims.contains(own)) return std::nullopt;
  if (!Truth::is_seen_surface(judged.truth.voxels().at(own))) return std::nullopt;
  if (is_obstructed(judged.truth, face, p)) return std::nullopt;
  constexpr int kSteps = 16;
  for (int i = 0; i <= kSteps; ++i) {
    const double height_m = c * (2.0 - 4.0 * i / kSteps);
    const VoxelIndex v = voxel_containing(p + height_m * face.normal, c);
    if (judged.claims.at_or(v, Occupancy::kUnknown) != Occupancy::kOccupied) continue;
    return face.normal.dot(centre_of(v, c) - p);
  }
  return std::nullopt;
}

std::vector<Column> columns_of(const Judged& judged, const WallFace& face) {
  constexpr int kFewest = 3;  // voxels, one above the other, that make a column
  const double c = judged.truth.voxel_m();
  std::vector<Column> columns;
  for (double s = 0.5 * c; s < face.length_m; s += c) {
    double sum = 0.0;
    int count = 0;
    for (double z = 0.5 * c; z < face.height_m; z += c) {
      const Eigen::Vector3d p = face.corner_m + s * face.along + Eigen::Vector3d(0, 0, z);
      const auto offset = offset_at(judged, face, p);
      if (!offset) continue;
      sum += *offset;
      ++count;
    }
    if (count >= kFewest) columns.push_back({s, sum / count});
  }
  return columns;
}

std::optional<FittedWall> fit(const Judged& judged, const WallFace& face) {
  constexpr std::size_t kFewestColumns = 8;
  constexpr double kSeenShare = 0.6;  // of its length
  const std::vector<Column> columns = columns_of(judged, face);
  const double c = judged.truth.voxel_m();
  const auto n = static_cast<double>(columns.size());
  if (columns.size() < kFewestColumns || n * c < kSeenShare * face.length_m) return std::nullopt;
  double mean_s = 0.0, mean_d = 0.0, ss = 0.0, sd = 0.0;
  for (const Column& column : columns) {
    mean_s += column.along_m / n;
    mean_d += column.offset_m / n;
  }
  for (const Column& column : columns) {
    ss += (column.along_m - mean_s) * (column.along_m - mean_s);
    sd += (column.along_m - mean_s) * (column.offset_m - mean_d);
  }
  FittedWall wall{face, sd / ss, 0.0, columns.size(), 0};
  for (const Column& column : columns) {
    const double stray_m = column.offset_m - mean_d - wall.slope * (column.along_m - mean_s);
    wall.rms_m += stray_m * stray_m / n;
    wall.straight += std::abs(stray_m) <= 0.5 * c ? 1 : 0;
  }
  wall.rms_m = std::sqrt(wall.rms_m);
  return wall;
}

/// Error of the angle [deg] between two walls that meet in a corner; nullopt if they do not.
std::optional<double> corner_error_deg(const FittedWall& a, const FittedWall& b) {
  constexpr double kMeet_m = 0.3;
  if (std::abs(a.face.normal.dot(b.face.normal)) > 0.1) return std::nullopt;
  const auto end = [](const WallFace& f, int i) -> Eigen::Vector3d {
    return f.corner_m + i * f.length_m * f.along;
  };
  double nearest_m = kMeet_m;
  for (const int i : {0, 1}) {
    for (const int j : {0, 1})
      nearest_m = std::min(nearest_m, (end(a.face, i) - end(b.face, j)).head<2>().norm());
  }
  if (nearest_m >= kMeet_m) return std::nullopt;
  // Both slopes turn their wall the same way about the vertical.
  return degrees(std::abs(std::atan(a.slope) - std::atan(b.slope)));
}

}  // namespace

/// Walls are the upright faces of boxes, at least 1.5 m long and high, of which 60 % were seen.
/// Where the map has a wall: the mean place of the first occupied voxels, column by column, and the
/// line through them. Straightness: RMS of the columns about their line, of the worst wall, and the
/// share of columns within half a voxel. Corners: how far the angles between walls that meet are
/// from the true ones.
ScoreResult score_walls(const Judged& judged) {
  std::vector<FittedWall> walls;
  for (const WallFace& face : wall_faces(judged.truth.objects())) {
    if (const auto wall = fit(judged, face)) walls.push_back(*wall);
  }
  if (walls.empty()) return {};
  double worst_rms_m = 0.0, worst_corner = 0.0, sum_corner = 0.0;
  std::size_t columns = 0, straight = 0, corners = 0;
  for (std::size_t i = 0; i < walls.size(); ++i) {
    worst_rms_m = std::max(worst_rms_m, walls[i].rms_m);
    columns += walls[i].columns;
    straight += walls[i].straight;
    for (std::size_t j = 0; j < i; ++j) {
      const auto error = corner_error_deg(walls[i], walls[j]);
      if (!error) continue;
      ++corners;
      sum_corner += *error;
      worst_corner = std::max(worst_corner, *error);
    }
  }
  ScoreResult result{{{"wall straightness, RMS of the worst wall", worst_rms_m, Unit::kMetres,
                       false, walls.size()},
                      share("wall columns within half a voxel of their line", straight, columns)},
                     {}};
  if (corners == 0) return result;
  const double mean = sum_corner / static_cast<double>(corners);
  result.values.push_back({"corner angles off, mean", mean, Unit::kDegrees, false, corners});
  result.values.push_back(
      {"corner angles off, worst", worst_corner, Unit::kDegrees, false, corners});
  return result;
}

}  // namespace swiftlet::eval
