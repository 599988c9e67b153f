// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#pragma once

#include "swiftlet/frame/depth_image.hpp"

namespace swiftlet {

/// From where on a depth image does more harm than good. A limit of 1 for a share is none.
struct QualityLimits {
  double min_valid = 0.01;        ///< least share of pixels with a reading
  double max_saturated = 0.5;     ///< share of readings at the end of what 16 bits hold
  double max_at_one_value = 1.0;  ///< share of readings of one value; off: a wall close by has one
  double max_smeared = 0.8;       ///< share of depth edges that are ramps
  int max_frozen = 5;      ///< equal images in a row from a camera that moves; 0: never asked
  double max_rough = 0.6;  ///< share of neighbours that are of no one surface
};

/// What a depth image tells of its own quality (method 8 and 9). Nothing here needs to know the
/// camera.
struct FrameQuality {
  double valid = 0.0;         ///< share of pixels with a reading
  double saturated = 0.0;     ///< share of readings of 65535
  double at_one_value = 0.0;  ///< share of readings that have the most frequent value
  double smeared = 0.0;       ///< share of depth edges that are ramps; 0 with too few to tell
  double rough = 0.0;         ///< share of neighbours more than a quarter apart; likewise
};

/// Of the pixels, and of the readings.
struct ReadingShares {
  double valid = 0.0;
  double saturated = 0.0;
};
[[nodiscard]] ReadingShares shares_of_readings(const DepthImage& depth);

/// Looks at 4096 pixels, evenly over the image. Does not allocate.
[[nodiscard]] double share_at_one_value(const DepthImage& depth);

/// Blur of motion draws a depth edge out into a ramp. An edge is a change of depth by more than a
/// quarter between two pixels 24 apart, with next to none in the 24 before and behind, so that no
/// slanted surface counts; it is a ramp if it has readings all along and no step from one pixel to
/// the next makes a quarter of it. Asked along every 16th row and, apart from them, every 16th
/// column, because blur has a direction: the larger share of the two; 0 with fewer than 600 places.
/// Does not allocate.
[[nodiscard]] double share_of_smeared_edges(const DepthImage& depth);

/// Noise in every pixel has no surfaces: of two neighbours with a reading both, in every 16th row,
/// the share that differ by more than a quarter of the nearer; 0 with fewer than 500 such pairs.
/// Depth of a real camera has such a step at its edges only. Does not allocate.
[[nodiscard]] double share_of_rough_pairs(const DepthImage& depth);

[[nodiscard]] FrameQuality measure_quality(const DepthImage& depth);

}  // namespace swiftlet
