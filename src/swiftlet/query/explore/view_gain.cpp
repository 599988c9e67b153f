// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/query/explore/view_gain.hpp"

#include <algorithm>
#include <cmath>

#include "swiftlet/base/grid_ray.hpp"

namespace swiftlet {

bool ViewGain::mark(const BlockWindow& window, const VoxelIndex& v) {
  const BlockIndex b = block_of(v);
  const auto nx = static_cast<std::size_t>(window.size.x);
  const auto ny = static_cast<std::size_t>(window.size.y);
  const auto x = static_cast<std::size_t>(b.x - window.first.x);
  const auto y = static_cast<std::size_t>(b.y - window.first.y);
  const auto z = static_cast<std::size_t>(b.z - window.first.z);
  const std::size_t at = (z * ny + y) * nx + x;
  const auto offset = static_cast<unsigned>(offset_in_block(v));
  if (seen_[at] == BlockBits{}) touched_.push_back(at);
  std::uint64_t& word = seen_[at][offset / 64U];
  const std::uint64_t bit = std::uint64_t{1} << (offset % 64U);
  const bool is_new = (word & bit) == 0;
  word |= bit;
  return is_new;
}

std::size_t ViewGain::walk(const MapSnapshot& map, const Eigen::Vector3d& from,
                           const Eigen::Vector3d& to) {
  const VoxelBox window = voxel_box(map.window());
  const GridRay ray{from / map.voxel_m(), to / map.voxel_m()};
  const Clip clip = clip_to_box(ray, window);
  if (clip.is_empty()) return 0;
  std::size_t fresh = 0;
  GridWalk walk(ray, window, clip);
  do {
    const Occupancy state = thresholds_.classify(map.log_odds(walk.voxel()));
    if (state == Occupancy::kOccupied) break;
    if (state == Occupancy::kUnknown && mark(map.window(), walk.voxel())) ++fresh;
  } while (walk.advance());
  return fresh;
}

Expected<std::size_t> ViewGain::unknown_in_sight(const MapSnapshot& map,
                                                 const Transform<World, Camera>& T,
                                                 const ViewCamera& camera) {
  constexpr double kFarthest_m = 1e6;
  const Eigen::Vector3d& from = T.translation();
  if (!camera.is_sound() || !(from.array().abs() < kFarthest_m).all()) {
    return fail(ErrorCode::kUsage, "view", "the camera or its pose cannot be used",
                "give angles below 170 degrees, a range above 0 and a place within 1000 km");
  }
  seen_.resize(std::max(seen_.size(), map.window().block_count()));
  // Nothing of the window is farther away than this, if the camera is in it.
  const BlockIndex& n = map.window().size;
  const double diagonal_m = map.voxel_m() * kBlockEdge * Eigen::Vector3d(n.x, n.y, n.z).norm();
  const double range_m = std::min(camera.max_range_m, diagonal_m);
  const double right = std::tan(0.5 * camera.hfov_rad), down = std::tan(0.5 * camera.vfov_rad);
  const auto steps = [&](double half_width) {
    return static_cast<int>(std::ceil(2.0 * half_width * range_m / map.voxel_m()));
  };
  const int columns = std::max(1, steps(right)), rows = std::max(1, steps(down));
  std::size_t fresh = 0;
  for (int v = 0; v <= rows; ++v) {
    for (int u = 0; u <= columns; ++u) {
      const Eigen::Vector3d beam(right * (2.0 * u / columns - 1.0), down * (2.0 * v / rows - 1.0),
                                 1.0);
      fresh += walk(map, from, T * (range_m * beam));
    }
  }
  for (const std::size_t at : touched_) seen_[at] = BlockBits{};
  touched_.clear();
  return fresh;
}

}  // namespace swiftlet
