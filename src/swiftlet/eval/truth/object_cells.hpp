// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <functional>

#include "swiftlet/base/grid_ray.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet::eval {

/// How much of an object a cell holds.
enum class Holds : std::uint8_t {
  kNothing,  ///< no matter at all
  kSliver,   ///< some, but neither claim about the cell would be wrong
  kSolid,    ///< the cell is the object's
};

/// Calls visit(cell, kSliver or kSolid) for every cell of a box that holds some of an object.
///
/// kSolid: the centre of the cell lies in the object, more than a twentieth of an edge deep. An
/// object thinner than a cell would so fall between the centres; along its thin axes it counts as
/// one cell wide. A thinner cylinder has the cells that its axis runs through for half an edge or
/// more. Sheets (planes, meshes) have the cells they run through; a plane on the boundary of two
/// cells is in the one that its normal points away from. Ends of cylinders count as round where
/// slivers are concerned; meshes leave none.
void for_each_held_cell(const sim::Object& object, double voxel_m, const VoxelBox& box,
                        const std::function<void(const VoxelIndex&, Holds)>& visit);

/// Whether an object is thinner than a cell along a world axis (0 x, 1 y, 2 z), nearly: what is
/// turned counts for the axis that it is nearest to.
[[nodiscard]] bool is_thin_along(const sim::Object& object, int axis, double voxel_m);

/// Smallest extent of an object [m]; 0 for sheets.
[[nodiscard]] double thickness_of(const sim::Object& object);

}  // namespace swiftlet::eval
