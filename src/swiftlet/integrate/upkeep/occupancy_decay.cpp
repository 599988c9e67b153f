// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/upkeep/occupancy_decay.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace swiftlet {
namespace {

constexpr int kFromSureToUnknown = kOccupiedCell - kUnknownCell;
constexpr double kLongestShare = 0.25;  // of decay_s, that one frame counts for
constexpr double kFewestSteps = 8.0;    // taken at once: 16 looks from sure to unknown cost less
constexpr float kBandSigma = 3.0F;      // a reading so far behind a cell is not of it

/// Cells above unknown have the highest bit set: eight cells at a time.
constexpr std::uint64_t kAboveUnknown = 0x8080'8080'8080'8080U;
static_assert(kUnknownCell == 0x7f && sizeof(QuantizedLogOdds) == 1);

std::uint64_t row_of_cells(const VoxelBlock& block, int first) {
  std::uint64_t row = 0;
  std::memcpy(&row, &block.cells[static_cast<std::size_t>(first)], sizeof row);
  return row;
}

bool is_any_above_unknown(const VoxelBlock& block) {
  std::uint64_t all = 0;
  for (int first = 0; first < kBlockVoxels; first += kBlockEdge) all |= row_of_cells(block, first);
  return (all & kAboveUnknown) != 0;
}

int pixel(float place, int size) {
  return std::clamp(static_cast<int>(std::floor(place)), 0, size - 1);
}

}  // namespace

std::int32_t OccupancyDecay::steps_of(const Moment& moment) {
  Clock& clock = clocks_[moment.camera];
  if (clock.last && moment.stamp > *clock.last) {
    const double share = std::min(seconds(moment.stamp - *clock.last) / decay_s_, kLongestShare);
    clock.carried += share * kFromSureToUnknown;
  }
  clock.last = moment.stamp;
  if (clock.carried < kFewestSteps) return 0;
  const double whole = std::floor(clock.carried);
  clock.carried -= whole;
  return static_cast<std::int32_t>(whole);
}

/// By the bounding box of the cube, rounded outwards to tiles that are at most half as wide as its
/// image (or 4 pixels). Looks no further once a reading is nearer than `behind_m`.
OccupancyDecay::Sight OccupancyDecay::look(const CubeView& view, const CubeInView& cube,
                                           float behind_m) const {
  const float z_near = cube.z_near(), z_far = cube.z_far();
  if (z_near < 0.5F * view.voxel_m() || z_near > max_range_m_) return {};
  const auto place = [&](float edge, bool is_low, float focal, float centre) {
    const bool is_outward = is_low == (edge < 0.0F);
    return focal * edge / (is_outward ? z_near : z_far) + centre + 0.5F;
  };
  const Float3 &p = cube.p_camera, &half = cube.half_camera;
  const float left = place(p[0] - half[0], true, view.fx(), view.cx());
  const float right = place(p[0] + half[0], false, view.fx(), view.cx());
  const float top = place(p[1] - half[1], true, view.fy(), view.cy());
  const float bottom = place(p[1] + half[1], false, view.fy(), view.cy());
  if (right < 0.0F || bottom < 0.0F || left >= static_cast<float>(view.width()) ||
      top >= static_cast<float>(view.height()))
    return {};

  const int u0 = pixel(left, view.width()), u1 = pixel(right, view.width());
  const int v0 = pixel(top, view.height()), v1 = pixel(bottom, view.height());
  const DepthRangeTiles tiles = pyramid_->tiles();
  const auto longest = static_cast<unsigned>(std::max(u1 - u0, v1 - v0) + 1);
  const int half_width = static_cast<int>(std::bit_width(longest)) - 2;  // its logarithm
  const int level = std::clamp(half_width - DepthRangePyramid::kTileShift, 0, tiles.levels - 1);
  const int shift = level + DepthRangePyramid::kTileShift;
  const auto at = static_cast<std::size_t>(level);
  Sight sight{.is_in_view = true};
  for (int y = v0 >> shift; y <= v1 >> shift; ++y) {
    const std::int32_t* row = tiles.words + tiles.first[at] + std::ptrdiff_t{y} * tiles.width[at];
    for (int x = u0 >> shift; x <= u1 >> shift; ++x) {
      const auto tile = static_cast<std::uint32_t>(row[x]);
      sight.has_gaps = sight.has_gaps || (tile & DepthRangePyramid::kHasGaps) != 0;
      if (tile >> 16U == 0) continue;
      sight.nearest_m = std::min(sight.nearest_m, depth_m(tile & 0xfffeU));
      if (sight.nearest_m < behind_m) return sight;
    }
  }
  return sight;
}

/// Whether some cell of a cube may show nothing.
bool OccupancyDecay::may_show_nothing(const CubeView& view, const CubeInView& cube) const {
  if (cube.z_far() <= 0.0F) return false;
  if (cube.z_near() < view.voxel_m()) return true;  // too near to tell
  const Sight sight = look(view, cube, 0.0F);
  return sight.is_in_view && sight.has_gaps;
}

bool OccupancyDecay::is_nothing_there(const CubeView& view, const CubeInView& cell) const {
  const float z_m = cell.p_camera[2], z_far = cell.z_far();
  if (cell.z_near() < 0.5F * view.voxel_m() || z_far > max_range_m_) return false;
  const float behind_m = z_far + kBandSigma * sigma_per_z2_ * z_far * z_far;
  // The pixel in the middle settles most cells: they are seen or hidden.
  const float u = view.fx() * cell.p_camera[0] / z_m + view.cx() + 0.5F;
  const float v = view.fy() * cell.p_camera[1] / z_m + view.cy() + 0.5F;
  const bool is_in_view = u >= 0.0F && v >= 0.0F && u < static_cast<float>(view.width()) &&
                          v < static_cast<float>(view.height());
  if (!is_in_view) return false;
  const std::uint16_t reading = raw_->at(static_cast<int>(u), static_cast<int>(v));
  if (reading != 0 && depth_m(reading) <= behind_m) return false;
  const Sight sight = look(view, cell, behind_m);
  return sight.has_gaps && sight.nearest_m >= behind_m;
}

/// Takes steps off the cells of a block where nothing is. Returns how many.
std::size_t OccupancyDecay::decay_block(const CubeView& view, const BlockIndex& index,
                                        std::int32_t steps, RollingMap& map) const {
  const VoxelBlock* known = map.find(index);
  const CubeInView whole = view.cube(first_voxel(index), kBlockEdge);
  if (!is_any_above_unknown(*known) || !may_show_nothing(view, whole)) return 0;
  const VoxelIndex corner = first_voxel(index);
  VoxelBlock* block = nullptr;
  std::size_t count = 0;
  for (int first = 0; first < kBlockVoxels; first += kBlockEdge) {
    if ((row_of_cells(*known, first) & kAboveUnknown) == 0) continue;
    for (int x = 0; x < kBlockEdge; ++x) {
      const std::size_t place = static_cast<std::size_t>(first) + static_cast<std::size_t>(x);
      if (known->cells[place] <= kUnknownCell) continue;
      const VoxelIndex cell{corner.x + x, corner.y + first / kBlockEdge % kBlockEdge,
                            corner.z + first / (kBlockEdge * kBlockEdge)};
      if (!is_nothing_there(view, view.cube(cell, 1))) continue;
      if (block == nullptr) known = block = &map.writable(index);
      block->cells[place] = static_cast<QuantizedLogOdds>(
          std::max<std::int32_t>(block->cells[place] - steps, kUnknownCell));
      ++count;
    }
  }
  return count;
}

std::size_t OccupancyDecay::apply(const DepthView& view, const Moment& moment, RollingMap& map) {
  const std::int32_t steps = steps_of(moment);
  if (steps == 0) return 0;
  pyramid_ = &view.pyramid;
  raw_ = &view.depth.raw;
  unit_m_ = view.depth.unit_m;
  sigma_per_z2_ = static_cast<float>(moment.sigma_per_z2);
  max_range_m_ = static_cast<float>(moment.max_range_m);
  const CubeView cubes(view, map.voxel_m());
  std::size_t count = 0;
  map.for_each_known_block([&](const BlockIndex& index, const VoxelBlock&) {
    count += decay_block(cubes, index, steps, map);
  });
  return count;
}

}  // namespace swiftlet
