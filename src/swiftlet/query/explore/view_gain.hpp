// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstddef>
#include <vector>

#include "swiftlet/base/expected.hpp"
#include "swiftlet/map/map_snapshot.hpp"
#include "swiftlet/query/distance/block_bits.hpp"
#include "swiftlet/query/explore/view_camera.hpp"

namespace swiftlet {

/// What a view would tell: the unknown voxels that a camera would see from a pose.
///
/// Rays go out over the whole image, no farther apart than a voxel at the end of the range; each
/// passes free and unknown voxels up to the first occupied one, the end of the range or the rim of
/// the window. A voxel that many rays cross counts once.
/// Memory: a bit a voxel of the window, kept from question to question. Thread safety: one owner.
class ViewGain {
 public:
  /// `thresholds`: what counts as matter and as unknown.
  explicit ViewGain(const OccupancyThresholds& thresholds = {}) : thresholds_(thresholds) {}

  /// Unknown voxels in sight. Errors: kUsage if the camera is not sound or the pose not finite.
  /// Cost: O(rays x voxels along them): image area in voxels at the end of the range.
  [[nodiscard]] Expected<std::size_t> unknown_in_sight(const MapSnapshot& map,
                                                       const Transform<World, Camera>& T,
                                                       const ViewCamera& camera);

 private:
  std::size_t walk(const MapSnapshot& map, const Eigen::Vector3d& from, const Eigen::Vector3d& to);
  bool mark(const BlockWindow& window, const VoxelIndex& v);

  OccupancyThresholds thresholds_;
  std::vector<BlockBits> seen_;       // by block of the window
  std::vector<std::size_t> touched_;  // those that are not empty
};

}  // namespace swiftlet
