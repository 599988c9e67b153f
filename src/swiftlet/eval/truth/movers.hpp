// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <vector>

#include "swiftlet/eval/truth/dense_grid.hpp"
#include "swiftlet/eval/truth/sight.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet::eval {

/// What a camera without faults sees in a voxel, now, of things that move.
enum class MoverSight : std::uint8_t {
  kNothing,        ///< not seen, or holds a sliver only
  kMatter,         ///< solid, and a line of sight ends on it
  kLookedThrough,  ///< nothing that moves is in it, and a line of sight passes
};
using MoverSights = DenseGrid<MoverSight>;

/// The moving objects of a scene where they are at a time, in world coordinates.
[[nodiscard]] std::vector<sim::Object> movers_at(const sim::Scene& scene, Nanoseconds since_start);

/// Every voxel that a moving object enters during a flight, and those beside them.
[[nodiscard]] std::vector<VoxelIndex> swept_voxels(const sim::Scene& scene, double voxel_m,
                                                   const VoxelBox& box);

/// Fills `sights` for the objects of movers_at() and the lines of sight of a frame.
void see_movers(const std::vector<sim::Object>& movers, std::span<const SightLine> lines,
                double voxel_m, MoverSights& sights);

}  // namespace swiftlet::eval
