// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/upkeep/thin_obstacle_filter.hpp"

#include <algorithm>
#include <bit>

namespace swiftlet {
namespace {

/// The level of the pyramid whose tiles are asked before their pixels.
constexpr int kLevel = 1;
constexpr int kTile = DepthRangePyramid::kTile << kLevel;

}  // namespace

ThinObstacleFilter::ThinObstacleFilter()
    : image_(static_cast<int>(RidgeLimits::kMostReach_px) + kTile), slots_(kSlots) {
  touched_.reserve(kMostVoxels);
}

void ThinObstacleFilter::add(const VoxelIndex& voxel, const RollingMap& map) {
  std::size_t place = VoxelHash{}(voxel) & (kSlots - 1);
  while (slots_[place].frame == frame_ && slots_[place].voxel != voxel)
    place = (place + 1) & (kSlots - 1);
  Slot& slot = slots_[place];
  if (slot.frame != frame_) {
    if (touched_.size() == kMostVoxels) return;  // all there is looks thin: nothing is
    slot = {voxel, frame_, 0, map.log_odds(voxel)};
    touched_.push_back(static_cast<std::uint32_t>(place));
  }
  ++slot.hits;
}

void ThinObstacleFilter::collect(const DepthView& view, const RollingMap& map) {
  ++frame_;
  touched_.clear();
  const PreprocessedDepth& depth = view.depth;
  const float unit_m = depth.unit_m, voxel_m = static_cast<float>(map.voxel_m());
  const auto fx = static_cast<float>(view.intrinsics.fx()) / static_cast<float>(depth.ratio);
  limits_ = {.half_voxel_px = 0.5F * voxel_m * fx / unit_m,
             .least_behind = kBehindVoxels * voxel_m / unit_m,
             .behind_per_square = kBehindSigma * depth.sigma_per_z2 * depth.noise_left * unit_m};
  const DepthRangeTiles tiles = view.pyramid.tiles();
  if (tiles.levels <= kLevel + 1) return;  // an image of a few pixels
  image_.take(depth.raw);
  for (int v = 0; v * kTile < depth.raw.height(); ++v) {
    for (int u = 0; u * kTile < depth.raw.width(); ++u) {
      if (may_have_ridge(tiles, kLevel, u, v, limits_)) collect_tile(view, tiles, u, v, map);
    }
  }
}

void ThinObstacleFilter::collect_tile(const DepthView& view, const DepthRangeTiles& tiles,
                                      int tile_u, int tile_v, const RollingMap& map) {
  static_assert(RidgeTile::kEdge == kTile);
  const int tile = tiles.first[kLevel] + tile_v * tiles.width[kLevel] + tile_u;
  const int reach = limits_.reach_px(tiles.words[tile] & 0xfffe);
  const int u = tile_u * kTile, v = tile_v * kTile;
  const RidgeBits rows = find_ridges({&image_, u, v, reach}, limits_);
  for (int k = 0; k < kTile; ++k) {
    for (unsigned row = rows[static_cast<std::size_t>(k)]; row != 0; row &= row - 1)
      add_reading(view, u + std::countr_zero(row), v + k, map);
  }
}

void ThinObstacleFilter::add_reading(const DepthView& view, int u, int v, const RollingMap& map) {
  const PixelOrigin pixel = view.depth.origin_of(u, v);
  const double z_m = double{view.depth.unit_m} * view.depth.raw.at(u, v);
  const Eigen::Vector3d p_world =
      view.T_world_camera * view.intrinsics.back_project(pixel.u, pixel.v, z_m);
  const VoxelIndex voxel = voxel_containing(p_world, map.voxel_m());
  if (map.window().contains(block_of(voxel))) add(voxel, map);
}

std::size_t ThinObstacleFilter::protect(RollingMap& map) {
  std::size_t raised = 0;
  for (const std::uint32_t place : touched_) {
    const Slot& slot = slots_[place];
    if (slot.hits < kLeastHits) continue;
    const QuantizedLogOdds least = add_steps(slot.before, kGain);
    if (map.log_odds(slot.voxel) >= least) continue;
    map.writable(block_of(slot.voxel)).voxels[offset_in_block(slot.voxel)] = least;
    ++raised;
  }
  return raised;
}

}  // namespace swiftlet
