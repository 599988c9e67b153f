// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "swiftlet/eval/thesis/experiment_map.hpp"

namespace swiftlet::eval {

Expected<ExperimentResult> run_large_box(const ProgressFunction& progress);
Expected<ExperimentResult> run_small_box(const ProgressFunction& progress);

namespace {

// Voxels of 0.2 m; the camera hovers in the middle of voxel 0 along x and z, on the boundary of the
// voxels -1 and 0 along y. The faces of both boxes are at x = 2.1 m, the wall is at 3.6 m.
constexpr std::int32_t kFace = 10;
constexpr std::int32_t kWall = 18;
constexpr std::size_t kFrames = 100;

std::vector<int> occupied_in_row(const Mapper& mapper, std::int32_t x) {
  std::vector<int> found;
  for (int y = -8; y < 8; ++y) {
    const QuantizedLogOdds voxel = mapper.map().log_odds({x, y, 0});
    if (mapper.config().occupancy.classify(voxel) == Occupancy::kOccupied) found.push_back(y);
  }
  return found;
}

/// How many voxels behind the box, up to the wall, are not exactly unknown.
int known_behind(const Mapper& mapper) {
  int known = 0;
  for (std::int32_t x = kFace + 2; x <= kWall + 1; ++x) {
    for (const int y : {-1, 0}) known += mapper.map().log_odds({x, y, 0}) != kUnknownVoxel ? 1 : 0;
  }
  return known;
}

Figure axis_figure(const Mapper& mapper, const std::string& name) {
  Figure figure{name + "_axis", "Belief along the optical axis (127: unknown)", "distance [m]",
                "belief [0 .. 255]"};
  Curve curve{"voxels on the axis", {}, false};
  for (std::int32_t x = 1; x < 26; ++x)
    curve.points.emplace_back(0.2 * x, mapper.map().log_odds({x, 0, 0}));
  figure.curves = {std::move(curve)};
  return figure;
}

Check width_check(const Mapper& mapper) {
  const auto voxels = occupied_in_row(mapper, kFace);
  return {"width of the box", "exactly 2 occupied voxels, -1 and 0",
          fmt::format("{} occupied: {}", voxels.size(), fmt::join(voxels, ", ")),
          voxels == std::vector<int>{-1, 0}};
}

Check axis_check(const Mapper& mapper) {
  int most_before = 0;
  for (std::int32_t x = 3; x < kFace; ++x)
    most_before = std::max(most_before, int{mapper.map().log_odds({x, 0, 0})});
  const int peak = mapper.map().log_odds({kFace, 0, 0});
  return {"belief along the optical axis", "free falls below 10, the peak is above 245",
          fmt::format("at most {} before the box, {} at its face", most_before, peak),
          most_before < 10 && peak > 245};
}

ExperimentResult common(const Mapper& mapper, const std::string& name) {
  return {{width_check(mapper), axis_check(mapper)},
          {layer_figure(mapper, {{-2, -16, 0}, {24, 15, 0}}, name + "_layer",
                        "Belief in the layer of the camera"),
           axis_figure(mapper, name)}};
}

}  // namespace

Expected<ExperimentResult> run_large_box(const ProgressFunction& progress) {
  const auto mapper = map_of("sim:large_box", thesis_config(), kFrames, progress);
  if (!mapper) return tl::make_unexpected(mapper.error());
  ExperimentResult result = common(*mapper, "large_box");
  const auto claim = [&](int y) {
    return mapper->config().occupancy.classify(mapper->map().log_odds({kFace, y, 0}));
  };
  const bool is_free = claim(-2) == Occupancy::kFree && claim(1) == Occupancy::kFree;
  result.checks.push_back(
      {"outer voxels, with 3.5 cm of box each", "free", is_free ? "free" : "not free", is_free});
  const int known = known_behind(*mapper);
  result.checks.push_back({"the wall behind the box", "hidden: all voxels at 127",
                           fmt::format("{} voxels known", known), known == 0});
  return result;
}

Expected<ExperimentResult> run_small_box(const ProgressFunction& progress) {
  const auto mapper = map_of("sim:small_box", thesis_config(), kFrames, progress);
  if (!mapper) return tl::make_unexpected(mapper.error());
  ExperimentResult result = common(*mapper, "small_box");
  const int known = known_behind(*mapper);
  result.checks.push_back(
      {"the wall behind the box", "partly seen", fmt::format("{} voxels known", known), known > 0});
  return result;
}

}  // namespace swiftlet::eval
