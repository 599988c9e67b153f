// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/thin_hits.hpp"

#include <algorithm>
#include <cmath>

namespace swiftlet {
namespace {

constexpr std::size_t kDepths = 65536;
/// The level of the pyramid whose tiles are asked before their pixels.
constexpr int kLevel = 1;
constexpr int kTile = DepthPyramid::kTile << kLevel;

/// Something farther on one side at least, nothing near on the other: beside a near object a stereo
/// camera is blind on one side.
bool rises_above(int a, int b, int far) {
  return (a == 0 || a > far) && (b == 0 || b > far) && a + b != 0;
}

/// 0, no reading, outside of the image.
int reading_at(const Image<std::uint16_t>& raw, int u, int v) {
  const bool is_inside = u >= 0 && v >= 0 && u < raw.width() && v < raw.height();
  return is_inside ? raw.at(u, v) : 0;
}

bool is_on_ridge(const Image<std::uint16_t>& raw, int u, int v, const ThinHits::Limits& limits) {
  const int reach = limits.reach_px, far = limits.far;
  return rises_above(reading_at(raw, u - reach, v), reading_at(raw, u + reach, v), far) ||
         rises_above(reading_at(raw, u, v - reach), reading_at(raw, u, v + reach), far);
}

}  // namespace

ThinHits::ThinHits() : limits_(kDepths), slots_(kSlots) { touched_.reserve(kMostCells); }

void ThinHits::look_up_limits(const DepthView& view, double voxel_m) {
  const ConditionedDepth& depth = view.depth;
  const double unit_m = depth.unit_m;
  // Half a cell in pixels times device units; 1.5 cells; six deviations over the square of depth.
  const std::array wanted{0.5 * voxel_m * view.intrinsics.fx() / unit_m / depth.ratio,
                          1.5 * voxel_m / unit_m,
                          6.0 * double{depth.noise_per_m} * double{depth.noise_left} * unit_m};
  if (wanted == limits_of_) return;
  limits_of_ = wanted;
  for (std::size_t i = 1; i < kDepths; ++i) {
    const auto z = static_cast<double>(i);
    const double reach = std::clamp(std::floor(wanted[0] / z) + 1.0, 2.0, 64.0);
    const double far = std::min(z + std::max(wanted[1], wanted[2] * z * z), 65535.0);
    limits_[i] = {static_cast<std::uint16_t>(reach), static_cast<std::uint16_t>(far)};
  }
}

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

bool ThinHits::may_have_ridge(const PyramidTiles& tiles, int tile_u, int tile_v) const {
  const std::int32_t* words = tiles.words + tiles.first[kLevel];
  const int width = tiles.width[kLevel];
  const int height = (tiles.first[kLevel + 1] - tiles.first[kLevel]) / width;
  const auto word = [&](int u, int v) { return static_cast<std::uint32_t>(words[v * width + u]); };
  if (word(tile_u, tile_v) >> 16U == 0) return false;
  // The nearest reading looks farthest to the side, and needs the least behind it.
  const Limits& limits = limits_[word(tile_u, tile_v) & 0xfffeU];
  const int reach = (limits.reach_px + kTile - 1) / kTile;
  const auto is_behind = [&](int u, int v) { return word(u, v) >> 16U > limits.far; };
  for (int u = std::max(0, tile_u - reach); u <= std::min(width - 1, tile_u + reach); ++u) {
    if (is_behind(u, tile_v)) return true;
  }
  for (int v = std::max(0, tile_v - reach); v <= std::min(height - 1, tile_v + reach); ++v) {
    if (is_behind(tile_u, v)) return true;
  }
  return false;
}

void ThinHits::collect(const DepthView& view, const RollingMap& map) {
  ++frame_;
  touched_.clear();
  look_up_limits(view, map.voxel_m());
  const Image<std::uint16_t>& raw = view.depth.raw;
  pyramid_.build(raw, team_);
  const PyramidTiles tiles = pyramid_.tiles();
  const bool has_tiles = tiles.levels > kLevel + 1;
  for (int v = 0; v * kTile < raw.height(); ++v) {
    for (int u = 0; u * kTile < raw.width(); ++u) {
      if (!has_tiles || may_have_ridge(tiles, u, v)) collect_tile(view, u, v, map);
    }
  }
}

void ThinHits::collect_tile(const DepthView& view, int tile_u, int tile_v, const RollingMap& map) {
  const ConditionedDepth& depth = view.depth;
  const int u_end = std::min((tile_u + 1) * kTile, depth.raw.width());
  const int v_end = std::min((tile_v + 1) * kTile, depth.raw.height());
  for (int v = tile_v * kTile; v < v_end; ++v) {
    for (int u = tile_u * kTile; u < u_end; ++u) {
      const std::uint16_t z = depth.raw.at(u, v);
      if (z == 0 || !is_on_ridge(depth.raw, u, v, limits_[z])) continue;
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
