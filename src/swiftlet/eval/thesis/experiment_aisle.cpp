// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>

#include <algorithm>

#include "swiftlet/eval/thesis/experiment_map.hpp"

namespace swiftlet::eval {

Expected<ExperimentResult> run_aisle(const ProgressFunction& progress);

namespace {

/// Occupied voxels of the aisle's walls in one slice of 0.2 m along it, from floor to ceiling.
int occupied_at(const Mapper& mapper, std::int32_t x) {
  int count = 0;
  for (std::int32_t y = -5; y <= 4; ++y) {
    for (std::int32_t z = 0; z <= 12; ++z) {
      const QuantizedLogOdds voxel = mapper.map().log_odds({x, y, z});
      count += mapper.config().occupancy.classify(voxel) == Occupancy::kOccupied ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

/// From the start of the flight, where the far end is 12 m away: one second of it.
Expected<ExperimentResult> run_aisle(const ProgressFunction& progress) {
  constexpr std::size_t kFrames = 30;
  constexpr std::int32_t kFarEnd = 59;  // the door at 12 m, and a voxel before it
  ExperimentResult result;
  Figure figure{"aisle", "Occupied voxels along the aisle", "distance [m]", "occupied voxels"};
  std::vector<int> far_voxels;
  std::string got;
  for (const int n : {1, 4, 8, 16}) {
    MapperConfig config = thesis_config();
    config.depth.downsample = n;
    config.depth.max_range_m = 12.0;
    config.map.size_m = {30, 10, 6};
    const auto mapper = map_of("sim:aisle", config, kFrames, progress);
    if (!mapper) return tl::make_unexpected(mapper.error());
    Curve curve{fmt::format("n = {}", n), {}, false};
    far_voxels.push_back(0);
    for (std::int32_t x = 5; x < 62; ++x) {
      const int count = occupied_at(*mapper, x);
      curve.points.emplace_back(0.2 * x + 0.1, count);
      far_voxels.back() += x >= kFarEnd ? count : 0;
    }
    got += fmt::format("{}{} (n = {})", got.empty() ? "" : ", ", far_voxels.back(), n);
    figure.curves.push_back(std::move(curve));
    if (n == 1 || n == 16) {
      result.figures.push_back(layer_figure(*mapper, {{-5, -8, 6}, {62, 7, 6}},
                                            fmt::format("aisle_{}", n),
                                            fmt::format("The aisle at camera height, n = {}", n)));
    }
  }
  result.figures.insert(result.figures.begin(), std::move(figure));
  const bool is_falling = far_voxels[0] > far_voxels[2] && far_voxels[2] > far_voxels[3];
  result.checks.push_back({"occupied voxels at the far end, from 11.8 m on",
                           "they drop out as n grows to 8 and 16", got, is_falling});
  return result;
}

}  // namespace swiftlet::eval
