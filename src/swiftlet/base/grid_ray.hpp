// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "swiftlet/base/voxel_box.hpp"
#include "swiftlet/base/voxel_index.hpp"

namespace swiftlet {

/// A segment in units of voxels: the world position divided by voxel_m. Double, because a world
/// index has up to 31 bits and the laws of traversal (which voxels does a segment cross?) are to
/// hold wherever the window is.
struct GridRay {
  Eigen::Vector3d from;
  Eigen::Vector3d to;
};

/// The part of a segment inside a box, as parameters 0 <= begin <= end <= 1; begin > end if it
/// misses the box.
struct Clip {
  double begin = 0.0;
  double end = 1.0;
  [[nodiscard]] bool is_empty() const { return begin > end; }
};
[[nodiscard]] Clip clip_to_box(const GridRay& ray, const VoxelBox& box);

/// Walks through the voxels that a segment crosses, in order, one face at a time (Amanatides & Woo
/// 1987).
///
/// Crossing an edge or a corner steps along all its axes at once, so no voxel is visited that the
/// segment only touches, and the reversed segment visits the same voxels. Ends exactly in the last
/// voxel, whatever the rounding. REQUIRES: all coordinates finite and within +-2^30, clip not
/// empty.
class GridWalk {
 public:
  GridWalk(const GridRay& ray, const VoxelBox& box, const Clip& clip);

  [[nodiscard]] VoxelIndex voxel() const {
    return {axes_[0].voxel, axes_[1].voxel, axes_[2].voxel};
  }
  /// Parameter in [0, 1] at which the segment entered voxel().
  [[nodiscard]] double entered_at() const { return entered_at_; }
  /// Goes on to the next voxel; false at the end. (In the header: this is the inner loop of every
  /// ray.)
  bool advance() {
    const double t = std::min(std::min(crossing_[0], crossing_[1]), crossing_[2]);
    if (t == kNever) return false;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (crossing_[i] > t) continue;
      axes_[i].voxel += axes_[i].step;
      --axes_[i].remaining;
      crossing_[i] = axes_[i].next_crossing();
    }
    entered_at_ = t;
    return true;
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();

  struct Axis {
    double from;        // start [voxels]
    double per_voxels;  // 1 / (to - from); not used while remaining is 0
    std::int32_t voxel;
    std::int32_t step;
    std::int32_t remaining;  // faces still to be crossed before the last voxel

    // Computed anew from the face each time: adding up increments, as the original does, drifts
    // over long rays.
    [[nodiscard]] double next_crossing() const {
      if (remaining == 0) return kNever;
      return (static_cast<double>(voxel + (step > 0 ? 1 : 0)) - from) * per_voxels;
    }
  };
  static Axis make_axis(double from, double to, const Clip& clip, std::int32_t low,
                        std::int32_t high);

  std::array<Axis, 3> axes_;
  std::array<double, 3>
      crossing_;  // parameter of the next face along each axis; infinity where none is left
  double entered_at_;
};

}  // namespace swiftlet
