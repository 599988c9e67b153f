// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/thin_hits.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {
namespace {

/// What a pixel is compared with.
class Ridges {
 public:
  Ridges(const DepthView& view, double voxel_m)
      : raw_(view.depth.raw),
        half_width_(0.5 * voxel_m * view.intrinsics.fx() / double{view.depth.unit_m} /
                    view.depth.ratio),
        step_(1.5 * voxel_m / double{view.depth.unit_m}),
        step_per_square_(6.0 * double{view.depth.noise_per_m} * double{view.depth.noise_left} *
                         double{view.depth.unit_m}) {}

  [[nodiscard]] bool is_on_ridge(int u, int v, int z) const {
    const auto reach = std::clamp(static_cast<int>(half_width_ / z) + 1, 2, 64);
    const auto step = static_cast<int>(std::max(step_, step_per_square_ * z * z));
    return rises_above(at(u - reach, v), at(u + reach, v), z + step) ||
           rises_above(at(u, v - reach), at(u, v + reach), z + step);
  }

 private:
  /// Something farther on one side at least, nothing near on the other: beside a near object a
  /// stereo camera is blind on one side.
  [[nodiscard]] static bool rises_above(int a, int b, int far) {
    return (a == 0 || a > far) && (b == 0 || b > far) && a + b != 0;
  }
  [[nodiscard]] int at(int u, int v) const {
    const bool is_inside = u >= 0 && v >= 0 && u < raw_.width() && v < raw_.height();
    return is_inside ? raw_.at(u, v) : 0;
  }

  const Image<std::uint16_t>& raw_;
  double half_width_;       // half a cell, in pixels times device units
  double step_;             // how much farther the background is, in device units
  double step_per_square_;  // or six deviations of the reading, over its square
};

}  // namespace

void ThinHits::add(const VoxelIndex& cell, const RollingMap& map) {
  std::size_t place = VoxelHash{}(cell) & (kSlots - 1);
  while (slots_[place].frame == frame_ && slots_[place].cell != cell)
    place = (place + 1) & (kSlots - 1);
  Slot& slot = slots_[place];
  if (slot.frame != frame_) {
    if (touched_.size() == kMostCells) return;  // all there is looks thin: nothing is
    slot = {cell, frame_, 0, map.log_odds(cell)};
    touched_.push_back(static_cast<std::uint32_t>(place));
  }
  ++slot.hits;
}

void ThinHits::collect(const DepthView& view, const RollingMap& map) {
  ++frame_;
  touched_.clear();
  const Ridges ridges(view, map.voxel_m());
  const ConditionedDepth& depth = view.depth;
  for (int v = 0; v < depth.raw.height(); ++v) {
    for (int u = 0; u < depth.raw.width(); ++u) {
      const int z = depth.raw.at(u, v);
      if (z == 0 || !ridges.is_on_ridge(u, v, z)) continue;
      const PixelOrigin pixel = depth.origin_of(u, v);
      const double z_m = double{depth.unit_m} * z - double{depth.shift_m};
      const Eigen::Vector3d p_world =
          view.T_world_camera * view.intrinsics.back_project(pixel.u, pixel.v, z_m);
      const VoxelIndex cell = voxel_containing(p_world, map.voxel_m());
      if (map.window().contains(block_of(cell))) add(cell, map);
    }
  }
}

std::size_t ThinHits::protect(RollingMap& map) {
  std::size_t raised = 0;
  for (const std::uint32_t place : touched_) {
    const Slot& slot = slots_[place];
    if (slot.hits < kLeastHits) continue;
    const LogOdds least = add_steps(slot.before, kGain);
    if (map.log_odds(slot.cell) >= least) continue;
    map.writable(block_of(slot.cell)).cells[offset_in_block(slot.cell)] = least;
    ++raised;
  }
  return raised;
}

}  // namespace swiftlet
