// SPDX-License-Identifier: Apache-2.0
// Copyright the Swiftlet authors

#include <array>

#include "swiftlet/preprocess/depth_step.hpp"

// A depth step is one file, which ends in make_<name>(), and one line here.
#define SWIFTLET_DEPTH_STEPS(X)                                                                 \
  X(distortion, "straightens depths that a bent stereo pair bends; see `swiftlet calibrate`")   \
  X(range_gate, "drops readings outside depth.min_range_m .. depth.max_range_m")                \
  X(lone_pixels, "drops readings that too few of their neighbours bear out: edges, mismatches") \
  X(smooth, "drops them, too, and replaces the others by the mean of their neighbours")         \
  X(near_downsample, "keeps the nearest valid pixel of every n x n, n = depth.downsample")

namespace swiftlet {

#define SWIFTLET_DECLARE(name, summary) \
  std::unique_ptr<DepthStep> make_##name(const PreprocessOptions& options);
SWIFTLET_DEPTH_STEPS(SWIFTLET_DECLARE)
#undef SWIFTLET_DECLARE

std::span<const Registered<MakeDepthStep>> depth_steps() {
#define SWIFTLET_LINE(name, summary) Registered<MakeDepthStep>{#name, summary, make_##name},
  static constexpr std::array kSteps{SWIFTLET_DEPTH_STEPS(SWIFTLET_LINE)};
#undef SWIFTLET_LINE
  return kSteps;
}

}  // namespace swiftlet
