// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include <cstdint>

#include "swiftlet/base/frame_of.hpp"
#include "swiftlet/frame/intrinsics.hpp"
#include "swiftlet/integrate/image/depth_range_pyramid.hpp"
#include "swiftlet/preprocess/preprocessed_depth.hpp"

namespace swiftlet {

/// One preprocessed frame, as it is integrated. Refers to what it was made of, which must outlive
/// it.
struct DepthView {
  const PreprocessedDepth& depth;
  const DepthRangePyramid& pyramid;     ///< of depth.raw
  const PinholeIntrinsics& intrinsics;  ///< of the full image
  const Transform<World, Camera>& T_world_camera;
  std::uint64_t frame_number;  ///< seeds the rounding; counts frames of the map from 0
};

}  // namespace swiftlet
