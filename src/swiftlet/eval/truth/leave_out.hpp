// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <span>
#include <vector>

#include "swiftlet/eval/truth/dense_grid.hpp"
#include "swiftlet/eval/truth/sight_line.hpp"
#include "swiftlet/frame/frame.hpp"
#include "swiftlet/preprocess/depth_step.hpp"

namespace swiftlet::eval {

/// How well a map predicts frames that it was not made from: for recordings, where nobody knows the
/// truth.
struct Consistency {
  std::size_t points = 0;   ///< readings of the frames that were left out
  std::size_t met = 0;      ///< of these, with an occupied voxel within one voxel
  std::size_t blocked = 0;  ///< of these, whose ray meets an occupied voxel more than two before

  [[nodiscard]] double met_share() const { return of_all(met); }
  [[nodiscard]] double blocked_share() const { return of_all(blocked); }

 private:
  [[nodiscard]] double of_all(std::size_t part) const {
    return points == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(points);
  }
};

/// Every fifth frame is left out, the first one never: a map of four predicts the fifth.
[[nodiscard]] constexpr bool is_left_out(std::size_t frame_number) { return frame_number % 5 == 4; }

/// Appends every stride-th reading (row and column) of a frame, within range, as a line of sight.
void append_readings(const Frame& frame, const PreprocessOptions& range, int stride_px,
                     std::vector<SightLine>& lines);

/// The box of voxels around lines of sight. REQUIRES: lines not empty.
[[nodiscard]] VoxelBox box_around(std::span<const SightLine> lines, double voxel_m);

[[nodiscard]] Consistency consistency_of(const Claims& claims, std::span<const SightLine> lines,
                                         double voxel_m);

}  // namespace swiftlet::eval
