// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include "swiftlet/integrate/upkeep/occupancy_decay.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "swiftlet/integrate/projective/range_image_intersector.hpp"

namespace swiftlet {
namespace {

constexpr int kFromSureToUnknown = kOccupiedVoxel - kUnknownVoxel;
constexpr double kLongestShare = 0.25;  // of decay_s, that one frame counts for
constexpr double kFewestSteps = 8.0;    // taken at once: 16 looks from sure to unknown cost less
constexpr float kBandSigma = 3.0F;      // a reading so far behind a voxel is not of it

/// Voxels above unknown have the highest bit set: eight voxels at a time.
constexpr std::uint64_t kAboveUnknown = 0x8080'8080'8080'8080U;
static_assert(kUnknownVoxel == 0x7f && sizeof(QuantizedLogOdds) == 1);

std::uint64_t row_of_voxels(const VoxelBlock& block, int first) {
  std::uint64_t row = 0;
  std::memcpy(&row, &block.voxels[static_cast<std::size_t>(first)], sizeof row);
  return row;
}

bool is_any_above_unknown(const VoxelBlock& block) {
  std::uint64_t all = 0;
  for (int first = 0; first < kBlockVoxels; first += kBlockEdge) all |= row_of_voxels(block, first);
  return (all & kAboveUnknown) != 0;
}

/// One frame, as decay looks at it.
class DecayView {
 public:
  DecayView(const DepthView& view, const OccupancyDecay::Moment& moment, double voxel_m)
      : cubes_(view, voxel_m),
        params_(view_params(cubes_, view.depth.unit_m)),
        tiles_(view.pyramid.tiles()),
        raw_(view.depth.raw),
        sigma_per_z2_(static_cast<float>(moment.sigma_per_z2)),
        max_range_m_(static_cast<float>(moment.max_range_m)) {}

  [[nodiscard]] CubeInView cube(const VoxelIndex& first, int edge) const {
    return cubes_.cube(first, edge);
  }
  /// Whether some voxel of a block may show nothing.
  [[nodiscard]] bool may_show_nothing(const CubeInView& block) const;
  /// Whether a voxel is in view and no reading of the pixel in its middle is of it: that settles
  /// most, they are seen or hidden.
  [[nodiscard]] bool may_be_empty(const CubeInView& voxel) const;
  /// For voxels that may be empty: whether part of their image has no reading, and no reading is at
  /// them or before them.
  void find_empty(const CubeBatch& voxels, std::array<bool, CubeBatch::kMost>& is_empty) const;

 private:
  /// Tiles of half the width: more of what a voxel's image covers, less of what lies beside it.
  static constexpr int kFiner = 1;

  [[nodiscard]] float behind_m(float z_far) const {
    return z_far + kBandSigma * sigma_per_z2_ * z_far * z_far;
  }
  [[nodiscard]] float depth_m(std::int32_t reading) const {
    return params_.unit_m * static_cast<float>(reading);
  }

  CubeView cubes_;
  ViewParams params_;
  DepthRangeTiles tiles_;
  const Image<std::uint16_t>& raw_;
  float sigma_per_z2_, max_range_m_;
};

bool DecayView::may_show_nothing(const CubeInView& block) const {
  if (block.z_far() <= 0.0F) return false;
  if (block.z_near() < params_.voxel_m) return true;  // too near to tell
  if (block.z_near() > max_range_m_) return false;
  CubeBatch batch;
  batch.half_camera = block.half_camera;
  batch.add(block.p_camera);
  ImageRanges ranges;
  find_image_ranges(params_, tiles_, kFiner, batch, ranges);
  return ranges.is_in_view[0] && ranges.has_gaps[0];
}

bool DecayView::may_be_empty(const CubeInView& voxel) const {
  const float z_m = voxel.p_camera[2], z_far = voxel.z_far();
  if (voxel.z_near() < 0.5F * params_.voxel_m || z_far > max_range_m_) return false;
  const float u = params_.fx * voxel.p_camera[0] / z_m + params_.u_offset;
  const float v = params_.fy * voxel.p_camera[1] / z_m + params_.v_offset;
  const bool is_in_view = u >= 0.0F && v >= 0.0F && u < params_.width && v < params_.height;
  if (!is_in_view) return false;
  const std::uint16_t reading = raw_.at(static_cast<int>(u), static_cast<int>(v));
  return reading == 0 || depth_m(reading) > behind_m(z_far);
}

void DecayView::find_empty(const CubeBatch& voxels,
                           std::array<bool, CubeBatch::kMost>& is_empty) const {
  ImageRanges ranges;
  find_image_ranges(params_, tiles_, kFiner, voxels, ranges);
  for (std::size_t i = 0; i < voxels.count; ++i) {
    const bool is_behind =
        ranges.farthest[i] == 0 ||
        depth_m(ranges.nearest[i]) >= behind_m(voxels.z[i] + voxels.half_camera[2]);
    is_empty[i] = ranges.has_gaps[i] && is_behind;
  }
}

/// Takes steps off the voxels of a block where nothing is. Returns how many.
std::size_t decay_block(const DecayView& view, const BlockIndex& index, std::int32_t steps,
                        RollingMap& map) {
  const VoxelBlock* known = map.find(index);
  const VoxelIndex corner = first_voxel(index);
  if (!is_any_above_unknown(*known) || !view.may_show_nothing(view.cube(corner, kBlockEdge)))
    return 0;
  std::size_t count = 0;
  for (int first = 0; first < kBlockVoxels; first += kBlockEdge) {
    if ((row_of_voxels(*known, first) & kAboveUnknown) == 0) continue;
    CubeBatch row;
    std::array<std::size_t, kBlockEdge> places{};
    for (int x = 0; x < kBlockEdge; ++x) {
      const std::size_t place = static_cast<std::size_t>(first) + static_cast<std::size_t>(x);
      if (known->voxels[place] <= kUnknownVoxel) continue;
      const CubeInView voxel = view.cube({corner.x + x, corner.y + first / kBlockEdge % kBlockEdge,
                                          corner.z + first / (kBlockEdge * kBlockEdge)},
                                         1);
      if (!view.may_be_empty(voxel)) continue;
      row.half_camera = voxel.half_camera;
      places[row.count] = place;
      row.add(voxel.p_camera);
    }
    if (row.count == 0) continue;
    std::array<bool, CubeBatch::kMost> is_empty{};
    view.find_empty(row, is_empty);
    for (std::size_t i = 0; i < row.count; ++i) {
      if (!is_empty[i]) continue;
      QuantizedLogOdds& voxel = map.writable(index).voxels[places[i]];
      voxel = static_cast<QuantizedLogOdds>(std::max<std::int32_t>(voxel - steps, kUnknownVoxel));
      ++count;
    }
    known = map.find(index);  // writing may have moved it
  }
  return count;
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

std::size_t OccupancyDecay::apply(const DepthView& view, const Moment& moment, RollingMap& map) {
  const std::int32_t steps = steps_of(moment);
  if (steps == 0) return 0;
  const DecayView frame(view, moment, map.voxel_m());
  std::size_t count = 0;
  map.for_each_known_block([&](const BlockIndex& index, const VoxelBlock&) {
    count += decay_block(frame, index, steps, map);
  });
  return count;
}

}  // namespace swiftlet
