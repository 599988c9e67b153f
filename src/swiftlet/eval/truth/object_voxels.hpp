// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>
#include <functional>

#include "swiftlet/base/grid_ray.hpp"
#include "swiftlet/sim/scene.hpp"

namespace swiftlet::eval {

/// How much of an object a voxel holds.
enum class Holds : std::uint8_t {
  kNothing,  ///< no matter at all
  kSliver,   ///< some, but neither claim about the voxel would be wrong
  kSolid,    ///< the voxel is the object's
};

/// Calls visit(voxel, kSliver or kSolid) for every voxel of a box that holds some of an object.
///
/// kSolid: the centre of the voxel lies in the object, more than a twentieth of an edge deep. An
/// object thinner than a voxel would so fall between the centres; along its thin axes it counts as
/// one voxel wide. A thinner cylinder has the voxels that its axis runs through for half an edge or
/// more. Sheets (planes, meshes) have the voxels they run through; a plane on the boundary of two
/// voxels is in the one that its normal points away from. Ends of cylinders count as round where
/// slivers are concerned; meshes leave none.
void for_each_held_voxel(const sim::Object& object, double voxel_m, const VoxelBox& box,
                         const std::function<void(const VoxelIndex&, Holds)>& visit);

/// Whether an object is thinner than a voxel along a world axis (0 x, 1 y, 2 z), nearly: what is
/// turned counts for the axis that it is nearest to.
[[nodiscard]] bool is_thin_along(const sim::Object& object, int axis, double voxel_m);

/// Smallest extent of an object [m]; 0 for sheets.
[[nodiscard]] double thickness_of(const sim::Object& object);

}  // namespace swiftlet::eval
