// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/eval/camera/calibration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "swiftlet/eval/camera/depth_recording.hpp"

namespace swiftlet::eval {
namespace {

Expected<WallImages> read_wall(const std::string& source, std::size_t frames) {
  auto recording = open_depth_recording(source);
  if (!recording) return forward_error(std::move(recording));
  std::optional<WallImages> wall;
  while (!wall || wall->images.size() < frames) {
    auto frame = recording->stream->next();
    if (!frame) return forward_error(std::move(frame));
    if (!*frame) break;
    if (!wall) wall.emplace(WallImages{{}, (*frame)->intrinsics});
    if ((*frame)->intrinsics == wall->intrinsics)
      wall->images.push_back(std::move((*frame)->depth));
  }
  if (wall) return std::move(*wall);
  return fail(ErrorCode::kCorruptInput, source, "it has no depth image", "record some");
}

/// The images of a wall as they are read and after each correction, for figures.
struct Version {
  std::string name;
  WallImages wall;
};
std::vector<Version> versions_of(const CalibratedWall& wall) {
  std::vector<Version> versions{{"raw", wall.raw},
                                {"self-calibrated", straightened(wall.raw, wall.self.distortion)}};
  if (wall.pre) versions.push_back({"pre-calibrated", straightened(wall.raw, *wall.pre)});
  return versions;
}

/// The mean of five bins, the middle ones weighing more: readings come in steps of disparity, and
/// bins would show nothing but how many steps fall into each.
double smoothed(const std::vector<std::size_t>& counts, std::size_t bin) {
  double sum = 0.0;
  for (const int offset : {-2, -1, 0, 1, 2}) {
    const auto at = static_cast<std::ptrdiff_t>(bin) + offset;
    if (at < 0 || at >= std::ssize(counts)) continue;
    sum += (3 - std::abs(offset)) * static_cast<double>(counts[static_cast<std::size_t>(at)]);
  }
  return sum / 9.0;
}

/// Share of readings by depth, over the range that all but one in 200 of the raw ones lie in.
Figure histogram(const CalibratedWall& wall, const std::vector<Version>& versions,
                 const std::string& name) {
  constexpr std::size_t kBins = 64;
  Figure figure{"histogram_" + name, fmt::format("Depth of a wall at {:.2f} m", wall.distance_m),
                "depth [m]", "share of readings [%]"};
  std::vector<float> raw_m;
  const auto for_each_depth = [](const WallImages& images, auto&& visit) {
    constexpr std::size_t kEvery = 7;  // enough for a curve
    for (const DepthImage& depth : images.images) {
      const auto pixels = depth.raw.pixels();
      for (std::size_t i = 0; i < pixels.size(); i += kEvery) {
        if (pixels[i] != 0) visit(static_cast<float>(pixels[i]) * depth.unit_m);
      }
    }
  };
  for_each_depth(wall.raw, [&](float z_m) { raw_m.push_back(z_m); });
  std::ranges::sort(raw_m);
  const std::size_t tail = raw_m.size() / 200;
  const double low_m = std::min(double{raw_m[tail]}, 0.95 * wall.distance_m);
  const double high_m = std::max(double{raw_m[raw_m.size() - 1 - tail]}, 1.05 * wall.distance_m);
  const double bin_m = (high_m - low_m) / double{kBins};
  for (const Version& version : versions) {
    std::vector<std::size_t> counts(kBins, 0);
    std::size_t readings = 0;
    for_each_depth(version.wall, [&](float z_m) {
      ++readings;
      const double bin = (double{z_m} - low_m) / bin_m;
      if (bin >= 0.0 && bin < double{kBins}) ++counts[static_cast<std::size_t>(bin)];
    });
    Curve curve{version.name, {}, false};
    for (std::size_t i = 0; i < kBins; ++i) {
      const double share = smoothed(counts, i) / static_cast<double>(readings);
      curve.points.emplace_back(low_m + (static_cast<double>(i) + 0.5) * bin_m, 100.0 * share);
    }
    figure.curves.push_back(std::move(curve));
  }
  return figure;
}

/// Mean depth of strips of columns, over the middle third of the rows of all images.
Figure top_view(const CalibratedWall& wall, const std::vector<Version>& versions,
                const std::string& name) {
  constexpr int kStrips = 106;
  Figure figure{"top_view_" + name, fmt::format("Top view of a wall at {:.2f} m", wall.distance_m),
                "X, to the right [m]", "depth [m]"};
  for (const Version& version : versions) {
    const PinholeIntrinsics& k = version.wall.intrinsics;
    Curve curve{version.name, {}, false};
    for (int strip = 0; strip < kStrips; ++strip) {
      const int u0 = strip * k.width() / kStrips, u1 = (strip + 1) * k.width() / kStrips;
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      double readings = 0.0;
      for (const DepthImage& depth : version.wall.images) {
        for (int v = k.height() / 3; v < 2 * k.height() / 3; ++v) {
          for (int u = u0; u < u1; ++u) {
            if (depth.raw.at(u, v) == 0) continue;
            sum += k.back_project(u, v, double{depth.unit_m} * depth.raw.at(u, v));
            ++readings;
          }
        }
      }
      if (readings > 0.0) curve.points.emplace_back(sum.x() / readings, sum.z() / readings);
    }
    figure.curves.push_back(std::move(curve));
  }
  const auto& raw = figure.curves.front().points;
  if (raw.empty()) return figure;
  figure.curves.push_back(
      {"wall", {{raw.front().first, wall.distance_m}, {raw.back().first, wall.distance_m}}, false});
  return figure;
}

}  // namespace

Expected<CalibratedWall> calibrate_wall(const std::string& source, std::optional<double> distance_m,
                                        std::size_t frames,
                                        const std::optional<DepthDistortion>& pre) {
  auto raw = read_wall(source, frames);
  if (!raw) return forward_error(std::move(raw));
  auto fit = fit_distortion(*raw, distance_m);
  if (!fit) {
    fit.error().where = source;
    return forward_error(std::move(fit));
  }
  CalibratedWall wall{source, fit->distance_m, *fit, pre, std::move(*raw)};
  wall.raw_error = worst_error(wall.raw, wall.distance_m);
  wall.self_error = worst_error(straightened(wall.raw, wall.self.distortion), wall.distance_m);
  if (pre) wall.pre_error = worst_error(straightened(wall.raw, *pre), wall.distance_m);
  return wall;
}

std::vector<Figure> calibration_figures(const CalibratedWall& wall, const std::string& name) {
  const std::vector<Version> versions = versions_of(wall);
  return {histogram(wall, versions, name), top_view(wall, versions, name)};
}

}  // namespace swiftlet::eval
