// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <array>
#include <cstdint>

#include "swiftlet/integrate/image/depth_range_pyramid.hpp"
#include "swiftlet/integrate/projective/kernel_params.hpp"

namespace swiftlet {

/// What a frame can say about a cube of voxels.
enum class UpdateType : std::uint8_t {
  kUnobserved,        ///< out of view, without readings, or hidden behind them
  kFree,              ///< every pixel of its image has a reading that passes it
  kFreeOrUnobserved,  ///< every reading of its image passes it; some pixels have none
  kPossiblyOccupied,  ///< may hold a surface, or is too near to tell
};

/// Nearer than so many voxels, the formula for the area of a voxel's image is too rough.
inline constexpr float kNearVoxels = 4.0F;

/// Cubes of one size that are looked at together.
struct CubeBatch {
  static constexpr std::size_t kMost = 16;

  std::size_t count = 0;
  Float3 half_camera{};                                ///< as in CubeInView
  alignas(64) std::array<float, kMost> x{}, y{}, z{};  ///< centres [m, camera axes]

  void add(const Float3& p_camera) {
    x[count] = p_camera[0];
    y[count] = p_camera[1];
    z[count] = p_camera[2];
    ++count;
  }
};
using UpdateTypes = std::array<UpdateType, CubeBatch::kMost>;

/// The readings of the images of cubes: of the rectangles that their bounding boxes cover, rounded
/// outwards to tiles of the pyramid.
struct ImageRanges {
  std::array<std::int32_t, CubeBatch::kMost> nearest, farthest;  ///< raw; farthest 0: none
  std::array<bool, CubeBatch::kMost> is_in_view, has_gaps;
};

/// Finds them in tiles that are 2^finer times as fine as those that intersect_cubes() takes: at
/// most as wide as the rectangle, and more than half as wide. REQUIRES: all of each cube is half a
/// voxel or more before the camera. The same ranges on all instruction sets.
void find_image_ranges(const ViewParams& view, const DepthRangeTiles& tiles, int finer,
                       const CubeBatch& cubes, ImageRanges& ranges);

/// Types each cube by the readings of the rectangle that its bounding box covers in the image.
/// The same types on all instruction sets.
void intersect_cubes(const KernelParams& params, const DepthRangeTiles& tiles,
                     const CubeBatch& cubes, UpdateTypes& types);

}  // namespace swiftlet
