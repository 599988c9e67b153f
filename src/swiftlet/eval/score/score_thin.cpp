// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "swiftlet/eval/score/score.hpp"

namespace swiftlet::eval {

ScoreResult score_thin(const Judged& judged);

namespace {

struct ThinCount {
  std::size_t all = 0, found = 0, nearly_found = 0;
};

/// Distances [m] that thin objects are asked for at; a voxel counts for the first that is not below
/// four fifths of the least depth it was seen from.
constexpr std::array kDistances_m{1.0, 2.0, 4.0};

}  // namespace

/// Of the voxels of thin cylinders (up to 30 mm) that were in view, those called occupied, exactly
/// or within one voxel; by diameter and by the least depth they were seen from: up to 1.25, 2.5 and
/// 5 m count as 1, 2 and 4 m.
ScoreResult score_thin(const Judged& judged) {
  std::map<std::pair<int, double>, ThinCount> counts;  // by diameter [mm] and distance [m]
  for (const ThinVoxel& voxel : judged.thin) {
    if (voxel.nearest_m == 0.0F) continue;
    for (const double distance_m : kDistances_m) {
      if (voxel.nearest_m > 1.25 * distance_m) continue;
      const auto mm = static_cast<int>(std::lround(1e3 * voxel.diameter_m));
      ThinCount& count = counts[{mm, distance_m}];
      ++count.all;
      count.found += judged.claims.at(voxel.voxel) == Occupancy::kOccupied ? 1 : 0;
      count.nearly_found += is_occupied_within(judged.claims, voxel.voxel, 1) ? 1 : 0;
      break;
    }
  }
  ScoreResult result;
  for (const auto& [key, count] : counts) {
    const std::string name = fmt::format("thin {} mm at {} m: recall", key.first, key.second);
    result.values.push_back(share(name + ", exact", count.found, count.all));
    result.values.push_back(share(name + ", within 1 voxel", count.nearly_found, count.all));
  }
  return result;
}

}  // namespace swiftlet::eval
